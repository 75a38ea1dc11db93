#pragma once

#include <memory>
#include <string>

namespace kte {

/// A position in a file, for messages; empty for records made by a program. Ignored in comparisons: any two are equal.
struct file_place {
  std::shared_ptr<const std::string> file{};
  int line = 0, column = 0;  ///< from 1; in a binary file line 0 and the offset from 0

  friend bool operator==(const file_place&, const file_place&) { return true; }
};

/// The start of a message: "arm.json:12:5: ", "arm.kte, byte 120: ", or nothing.
[[nodiscard]] inline std::string to_string(const file_place& p) {
  if (!p.file) return "";
  const std::string column = std::to_string(p.column) + ": ";
  return *p.file + (p.line == 0 ? ", byte " + column : ":" + std::to_string(p.line) + ":" + column);
}

}  // namespace kte
