#pragma once

#include <kte/io/file.hpp>
#include <kte/io/mcap_table_reader.hpp>
#include <kte/io/npy_table_reader.hpp>
#include <kte/io/table_format.hpp>
#include <kte/io/text_table.hpp>

namespace kte {

/// Reads what a `table_writer` wrote, or another file of that form. Throws `bad_file` with the path, and the line and
/// column counted from 1, or the offset in bytes counted from 0, where something is wrong; also for a file cut off
/// within a row. Needs memory for the file and the numbers in it, whatever its headers claim.
inline table read_table(const std::filesystem::path& path, table_format format) {
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
/// In the format that the extension says. Throws `bad_argument` for an unknown one.
inline table read_table(const std::filesystem::path& path) { return read_table(path, format_of(path)); }

}  // namespace kte
