#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace kte {

/// Limits and warnings of reading a file: `load_model(path, {.max_bytes = 1 << 30})`.
struct read_options {
  /// The largest file, in bytes.
  std::size_t max_bytes = std::size_t{1} << 28;
  /// The largest number of items: elements, ports, parameters, roots, limits ...; each takes some 200 bytes.
  std::size_t max_items = std::size_t{1} << 23;
  /// Called for each skipped field. Only fields whose names begin with x_ may be skipped; without this function they
  /// are errors.
  std::function<void(const std::string&)> warn = nullptr;
};

}  // namespace kte
