#pragma once

#include <kte/contract/file_place.hpp>
#include <kte/errors.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace kte::detail {

/// Reads a file of any format field by field, as requested by its reader. Fields that are not requested are errors, so
/// nothing nests deeper than the reader does. Groups contain fields, which have names; lists contain items. After each
/// step `at` is the offset of what was read. Throws `bad_file`.
class field_scanner {
 public:
  virtual ~field_scanner() = default;
  virtual std::size_t at() const = 0;
  virtual void open_document() = 0;
  virtual void close_document() = 0;
  virtual void open_group(const std::string& what) = 0;
  virtual void open_list(const std::string& what) = 0;
  /// Whether the innermost group has another field, and stores its name; otherwise closes the group.
  virtual bool next_field(std::string& name) = 0;
  /// Whether the innermost list has an item with this number, from 0; otherwise closes the list.
  virtual bool next_item(std::size_t number) = 0;
  virtual std::string text(const std::string& name) = 0;
  /// Numbers as text, separated by blanks.
  virtual std::string numbers(const std::string& name) = 0;
  /// Reads numbers, if the file has binary numbers here and not text.
  virtual bool take_numbers(std::vector<double>&) { return false; }

  virtual file_place place(std::size_t offset) = 0;
  [[noreturn]] void fail_at(std::size_t offset, const std::string& why) {
    raise<bad_file>("kte: " + to_string(place(offset)) + why);
  }
};

}  // namespace kte::detail
