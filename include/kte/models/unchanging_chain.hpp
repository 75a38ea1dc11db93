#pragma once

#include <kte/runtime_chain.hpp>

namespace kte {

/// The runtime chain of a model. It is constant, because the model has a state of it.
class unchanging_chain : public runtime_chain {
 public:
  unchanging_chain(const runtime_chain& c) : runtime_chain(c) {}  // NOLINT(google-explicit-constructor)

  vec3<> gravity() const override { return runtime_chain::gravity(); }
  template <class E>
  void operator<<(E&&) = delete;
  void append(std::unique_ptr<kte_map>) = delete;
};

}  // namespace kte
