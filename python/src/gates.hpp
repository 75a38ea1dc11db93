#pragma once

#include <kte/runtime_chain/runtime_chain.hpp>

#include <functional>
#include <map>
#include <string>

namespace kte_python {

/// Whether a contact may land at a time and a state after doMotion; called without the GIL.
using gate = std::function<bool(double t, const kte::runtime_state& s)>;

/// The chain, whose rigid contacts of these names land only where their gates are open. Throws `unknown_name` for a
/// name that no contact has.
kte::runtime_chain with_gates(const kte::runtime_chain& c, const std::map<std::string, gate>& gates);

}  // namespace kte_python
