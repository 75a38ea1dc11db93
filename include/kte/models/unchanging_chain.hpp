#pragma once

#include <kte/runtime_chain/runtime_chain.hpp>

namespace kte {

/// The runtime chain that a model is: as it was when the model was made, for the model has a state of it to work in.
class unchanging_chain : public runtime_chain {
 public:
  unchanging_chain(const runtime_chain& c) : runtime_chain(c) {}  // NOLINT(google-explicit-constructor)

  vec3<> gravity() const override { return runtime_chain::gravity(); }
  template <class E>
  void operator<<(E&&) = delete;
  void append(std::unique_ptr<kte_map>) = delete;
};

}  // namespace kte
