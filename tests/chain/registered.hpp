#pragma once

#include <kte/chain/registry.hpp>

namespace models {

/// All elements of the library and those of tests: compiled once for all tests (chain/registered.cpp).
const kte::element_registry& registry();

/// A runtime chain from a record.
inline kte::kte_map_chain registered(const kte::model_record& record) { return to_chain(record, registry()); }

}  // namespace models
