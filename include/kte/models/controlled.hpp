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
    follow(t, x);
    return Model::operator()(t, x);
  }
  template <class T, class X>
  decltype(auto) computeStateRate(const T& t, const X& x) {
    follow(t, x);
    return Model::computeStateRate(t, x);
  }
  template <class T, class X>
  decltype(auto) state_at(const T& t, const X& x) {
    follow(t, x);
    return Model::state_at(t, x);
  }
  template <class T, class X>
  auto computeOutput(const T& t, const X& x) {
    follow(t, x);
    return Model::computeOutput(t, x);
  }
  template <class F>
  auto with_output(const F& f) const {
    auto m = Model::with_output(f);
    return controlled<decltype(m), Law>(m, law_);
  }
  /// Knows no time: a variational integrator would pass the law by.
  template <class X>
  void forces_at(const X&) const = delete;

 private:
  template <class T, class X>
  void follow(const T& t, const X& x) {
    this->setInput(law_(t, x));
  }

  Law law_;
};

}  // namespace kte
