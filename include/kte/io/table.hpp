#pragma once

#include <kte/errors.hpp>
#include <kte/io/utf8.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace kte {

/// Numbers in columns with `names`, read from a file or collected in memory.
struct table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< columns[j][i]: column j of row i

  /// The number of rows.
  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// The column of a name. Throws `unknown_name`.
  [[nodiscard]] const std::vector<double>& operator[](std::string_view name) const {
    const auto n = std::find(names.begin(), names.end(), name);
    if (n == names.end()) detail::raise<unknown_name>("kte: the table has no column '" + std::string(name) + "'");
    return columns[static_cast<std::size_t>(n - names.begin())];
  }
};

namespace detail {

inline constexpr std::string_view blanks = " \t\r\n\v\f";

/// Detects duplicate names.
class known_names {
 public:
  /// Adds a name; returns whether it is new.
  bool add(std::string_view name) { return names_.emplace(name).second; }

 private:
  std::set<std::string, std::less<>> names_;
};

/// Column names that every format can hold without escapes: without separators, and without characters that JSON or
/// Python would escape. Throws `bad_argument` for an empty list, and for a name that is empty, occurs twice, or
/// contains such a character.
inline const std::vector<std::string>& check_column_names(const std::vector<std::string>& names) {
  if (names.empty()) raise<bad_argument>("kte: a table needs a column");
  known_names known;
  for (const auto& n : names) {
    const auto has = [&n](const char* what) { raise<bad_argument>("kte: the column name '" + n + "' has " + what); };
    if (n.empty()) raise<bad_argument>("kte: a column of a table has no name");
    if (n.find_first_of(blanks) != n.npos) has("a blank");
    if (n.find(',') != n.npos) has("a comma");
    if (n.find_first_of("'\"\\") != n.npos) has("a quote or a backslash");
    for (std::string_view rest = n; !rest.empty(); rest.remove_prefix(1))
      if (begins_with_control(rest)) has("a control character");
    if (!known.add(n)) raise<bad_argument>("kte: two columns are named '" + n + "'");
  }
  return names;
}

}  // namespace detail
}  // namespace kte
