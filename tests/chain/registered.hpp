#pragma once

#include <kte/elements/registry.hpp>

/// Compiled once for all tests, with all elements (chain/registered.cpp).
extern template kte::element_registry kte::element_registry::standard<void>();

namespace models {

/// All elements of the library and those of tests.
const kte::element_registry& registry();

/// A runtime chain from a record.
inline kte::runtime_chain registered(const kte::model_record& record) { return to_chain(record, registry()); }

}  // namespace models
