#pragma once

#include <kte/io/file.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace kte {

/// The file formats of tables.
enum class table_format {
  ssv,  ///< text, columns separated by spaces: gnuplot
  csv,  ///< text, by commas: PlotJuggler, spreadsheets
  tsv,  ///< text, by tabs
  npy,  ///< NumPy
  mcap  ///< MCAP: Foxglove, PlotJuggler
};

namespace detail {

struct known_extension {
  std::string_view text;
  table_format format;
};
inline constexpr known_extension known_extensions[]{{".ssv", table_format::ssv}, {".txt", table_format::ssv},
                                                    {".csv", table_format::csv}, {".tsv", table_format::tsv},
                                                    {".npy", table_format::npy}, {".mcap", table_format::mcap}};

/// The separator of a text format.
constexpr char separator_of(table_format f) {
  return f == table_format::csv ? ',' : f == table_format::tsv ? '\t' : ' ';
}

}  // namespace detail

/// The format of a file by its extension. Throws `bad_argument`, listing the known ones.
[[nodiscard]] inline table_format format_of(const std::filesystem::path& path) {
  const std::string extension = detail::lower_extension(path);
  std::string known;
  for (const auto& e : detail::known_extensions) {
    if (e.text == extension) return e.format;
    known.append(known.empty() ? "" : " ").append(e.text);
  }
  detail::raise<bad_argument>("kte: the name '" + path.string() + "' has no extension of a table: " + known +
                              " (or give a table_format)");
}

}  // namespace kte
