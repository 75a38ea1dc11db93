#pragma once

#include <kte/runtime_chain/kte_map_chain.hpp>

namespace kte {

/// The runtime chain that a model is: as it was when the model was made, for the model has a state of it to work in.
class unchanging_chain : public kte_map_chain {
 public:
  unchanging_chain(const kte_map_chain& c) : kte_map_chain(c) {}  // NOLINT(google-explicit-constructor)

  vec3<> gravity() const override { return kte_map_chain::gravity(); }
  template <class E>
  void operator<<(E&&) = delete;
  void append(std::unique_ptr<kte_map>) = delete;
};

}  // namespace kte
