#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace kte {

/// What reading a file may take, and what it tells: `load_model(path, {.max_bytes = 1 << 30})`.
struct read_options {
  /// The largest file, in bytes.
  std::size_t max_bytes = std::size_t{1} << 28;
  /// The most things that it may hold: elements, ports, parameters, roots, limits ... each takes some 200 bytes.
  std::size_t max_items = std::size_t{1} << 23;
  /// Is told of each field that is left out: fields whose names begin with x_ may be. Without it they are errors.
  std::function<void(const std::string&)> warn = nullptr;
};

}  // namespace kte
