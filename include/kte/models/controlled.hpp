#pragma once

#include <utility>

namespace kte {

/// A model whose inputs follow a law u(t, x), at every evaluation:
///
///   kte::controlled arm(model, [&](double t, const auto& x) { return torques(t, x); });
///   kte::dormand_prince45 solver(std::ref(arm), 0.0, arm.make_x(q, v));
///
/// It is the model, so integrators know how its states move also where there are rotations. u(t, x) returns as many
/// numbers as there are inputs, anything with operator[]; else `setInput` throws.
template <class Model, class Law>
class controlled : public Model {
 public:
  controlled(const Model& m, Law u) : Model(m), law_(std::move(u)) {}

  template <class T, class X>
  decltype(auto) operator()(const T& t, const X& x) {
    this->setInput(law_(t, x));
    return Model::operator()(t, x);
  }

 private:
  Law law_;
};

}  // namespace kte
