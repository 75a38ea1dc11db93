#pragma once

#include <kte/io/file.hpp>
#include <kte/io/mcap_table_reader.hpp>
#include <kte/io/npy_table_reader.hpp>
#include <kte/io/table_format.hpp>
#include <kte/io/text_table.hpp>

namespace kte {

/// Reads a file of a `table_writer`, or another file of this format. Throws `bad_file` with the path, and the line and
/// column counted from 1, or the offset in bytes counted from 0, also for a file that ends within a row. Memory is
/// proportional to the actual size of the file, whatever its headers claim.
[[nodiscard]] inline table read_table(const std::filesystem::path& path, table_format format) {
  const std::string bytes = detail::read_file(path);
  switch (format) {
    case table_format::npy:
      return detail::read_npy_table(path, bytes);
    case table_format::mcap:
      return detail::mcap_table_reader(path, bytes).result();
    default:
      return detail::read_text_table(path, bytes, detail::separator_of(format));
  }
}
/// Reads a table in the format of its extension. Throws `bad_argument` for an unknown extension.
[[nodiscard]] inline table read_table(const std::filesystem::path& path) { return read_table(path, format_of(path)); }

}  // namespace kte
