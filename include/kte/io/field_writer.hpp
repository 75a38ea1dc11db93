#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kte::detail {

/// Writes a file of any format that `field_scanner` reads. Items of lists have no name.
class field_writer {
 public:
  virtual ~field_writer() = default;
  virtual void open_group(const std::string& name) = 0;
  virtual void open_list(const std::string& name) = 0;
  /// Closes the innermost group or list.
  virtual void close() = 0;
  virtual void text(const std::string& name, const std::string& value) = 0;
  virtual void numbers(const std::string& name, const std::vector<double>& values) = 0;
  virtual void whole_number(const std::string& name, int value) { text(name, std::to_string(value)); }
  /// Whether names of fields must be valid tag names.
  virtual bool has_tags() const { return false; }
  /// Returns the whole file; nothing can be written afterwards.
  virtual std::string finish() = 0;
};

}  // namespace kte::detail
