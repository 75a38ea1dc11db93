#pragma once

#include <kte/io/table_writer.hpp>

namespace kte {

/// A table as it was read.
struct table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< columns[j][i]: column j of row i

  /// The column of a name. Throws `unknown_name`.
  const std::vector<double>& operator[](std::string_view name) const {
    const auto n = std::find(names.begin(), names.end(), name);
    if (n == names.end()) detail::raise<unknown_name>("kte: the table has no column '" + std::string(name) + "'");
    return columns[static_cast<std::size_t>(n - names.begin())];
  }
};

namespace detail {

/// Cuts the first word off a text; empty where there is none.
inline std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const auto word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

}  // namespace detail

/// Reads what a `table_writer` wrote, or another file of that form. Throws `bad_file` with the path, the line and the
/// column, counted from 1, where something is wrong; also for a file cut off within a line.
inline table read_table(const std::filesystem::path& path) {
  std::string text;
  const auto f = detail::open_file(path, "rb");
  char part[4096];
  while (const auto n = std::fread(part, 1, sizeof part, f.get())) text.append(part, n);
  if (std::ferror(f.get())) detail::raise_file("read", path, errno);

  std::size_t line = 0, column = 0;
  const auto bad = [&](const std::string& what) {
    detail::raise<bad_file>("kte: '" + path.string() + "', line " + std::to_string(line) + what);
  };
  table t;
  for (std::string_view rest = text, words; ++line == 1 || !rest.empty();) {
    const auto end = rest.find('\n');
    if (end == rest.npos) bad(rest.empty() ? ": no column names" : ": no line end, the file is cut off");
    words = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    column = 0;
    for (auto word = detail::next_word(words); !word.empty(); word = detail::next_word(words)) {
      const auto where = [&] { return ", column " + std::to_string(++column) + ": '" + std::string(word) + "' "; };
      if (line == 1) {
        if (std::find(t.names.begin(), t.names.end(), word) != t.names.end()) bad(where() + "is there twice");
        t.names.emplace_back(word);
        t.columns.emplace_back();
      } else {
        if (column == t.names.size()) bad(where() + "is one too many");
        double x{};
        const auto [stop, code] = std::from_chars(word.data(), word.data() + word.size(), x);
        if (code != std::errc{} || stop != word.data() + word.size()) bad(where() + "is not a number");
        t.columns[column].push_back(x);
      }
      ++column;
    }
    if (t.names.empty()) bad(": no column names");
    if (column != t.names.size())
      bad(": " + std::to_string(column) + " numbers for " + std::to_string(t.names.size()) + " columns");
  }
  return t;
}

}  // namespace kte
