#pragma once

#include <memory>
#include <string>

namespace kte {

/// Where in a file something was read, for messages; nowhere for what a program made. It is no part of a value: any two
/// are equal.
struct file_place {
  std::shared_ptr<const std::string> file{};
  int line = 0, column = 0;  ///< from 1

  friend bool operator==(const file_place&, const file_place&) { return true; }
};

/// The start of a message: "arm.json:12:5: ", or nothing.
inline std::string to_string(const file_place& p) {
  return p.file ? *p.file + ":" + std::to_string(p.line) + ":" + std::to_string(p.column) + ": " : "";
}

}  // namespace kte
