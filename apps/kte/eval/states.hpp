#pragma once

#include <kte/io/file.hpp>
#include <kte/io/table_number.hpp>
#include <kte/io/text_encoding.hpp>
#include <kte/io/text_table.hpp>

#include <algorithm>
#include <cmath>
#include <map>

/// Tables of states: a line of column names, then a line of numbers a state, with commas between them.
namespace evaluate {

/// The largest table that is read, in bytes: as of the library's own files.
inline constexpr std::size_t largest_table = std::size_t{1} << 28;

/// A table by the names of its columns. Errors name file, line and column, in characters from 1.
class state_table {
 public:
  explicit state_table(const std::filesystem::path& path) : path_(path) {
    const std::string bytes = kte::detail::read_file(path, largest_table);
    if (bytes.size() > largest_table)
      throw kte::bad_file("kte: " + path.string() + ": has more than " + std::to_string(largest_table) + " bytes");
    if (const char* why = kte::detail::other_encoding(bytes)) throw kte::bad_file("kte: " + path.string() + ": " + why);
    std::string_view text = kte::detail::without_mark(bytes);
    for (int line = 1; !text.empty(); ++line) {
      const auto end = std::min(text.find('\n'), text.size());
      read_line(text.substr(0, end), line);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (names_.empty()) throw kte::bad_file("kte: " + path.string() + ": has no line of column names");
  }

  std::size_t rows() const { return rows_.size(); }
  /// The columns by their names.
  const std::map<std::string, std::size_t, std::less<>>& names() const { return names_; }
  const std::filesystem::path& path() const { return path_; }
  /// Which columns are prefix0, prefix1 ... up to count; none at all gives none, if they need not be there. Throws
  /// `kte::bad_file` with the names of those that are missing, and where there are more.
  std::vector<std::size_t> columns(const std::string& prefix, std::size_t count, bool needed) const {
    std::vector<std::size_t> found;
    std::string missing;
    for (std::size_t i = 0; i < count; ++i) {
      const auto c = names_.find(prefix + std::to_string(i));
      if (c != names_.end())
        found.push_back(c->second);
      else
        missing += (missing.empty() ? " " : ", ") + prefix + std::to_string(i);
    }
    if (!missing.empty() && (needed || !found.empty()))
      throw kte::bad_file("kte: " + path_.string() + ":1: missing columns:" + missing);
    if (names_.contains(prefix + std::to_string(count)))
      throw kte::bad_file("kte: " + path_.string() + ":1: a column " + prefix + std::to_string(count) +
                          ", but there are " + std::to_string(count) + " of them, from " + prefix + "0");
    return found;
  }
  double at(std::size_t row, std::size_t column) const { return rows_[row][column]; }
  /// The line of a row, for messages.
  std::string place(std::size_t row) const { return path_.string() + ":" + std::to_string(lines_[row]) + ": "; }

 private:
  /// "kte: states.csv:3:17: ", of a place in the text of a line.
  std::string place_in(std::string_view text, int line, const char* at) const {
    const auto is_first = [](char byte) {
      return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
    };  // of a character
    return "kte: " + path_.string() + ":" + std::to_string(line) + ":" +
           std::to_string(std::count_if(text.data(), at, is_first) + 1) + ": ";
  }
  void read_line(std::string_view text, int line) {
    if (const auto zero = text.find('\0'); zero != text.npos)
      throw kte::bad_file(place_in(text, line, text.data() + zero) + "here is a zero byte");
    auto rest = kte::detail::without_blanks(text);
    if (rest.empty()) return;
    const bool head = names_.empty();
    const bool ends_open = rest.ends_with(',');  // an empty cell is the last
    std::vector<double> numbers;
    std::size_t column = 0;
    const auto take = [&](std::string_view cell, const char* at) {
      const auto quoted = "'" + std::string(cell.substr(0, 80)) + "'";
      const auto bad = [&](const std::string& what) { throw kte::bad_file(place_in(text, line, at) + what); };
      ++column;
      if (head) {
        if (!names_.emplace(cell, column - 1).second) bad("a second column " + quoted);
        return;
      }
      double x{};
      if (column > names_.size()) bad("more numbers than the " + std::to_string(names_.size()) + " columns");
      if (!kte::detail::read_number(cell.starts_with('+') ? cell.substr(1) : cell, x)) bad(quoted + " is not a number");
      if (!std::isfinite(x)) bad(quoted + " is not finite");
      numbers.push_back(x);
    };
    for (std::string unquoted; !rest.empty();) {
      rest.remove_prefix(std::min(rest.find_first_not_of(kte::detail::blanks), rest.size()));
      const char* const at = rest.data();
      if (!rest.starts_with('"')) {
        take(kte::detail::next_cell(rest, ','), at);
        continue;
      }
      if (!kte::detail::next_quoted_cell(rest, ',', unquoted))
        throw kte::bad_file(place_in(text, line, at) + "'" + unquoted.substr(0, 80) +
                            "' does not end at its closing quote");
      take(kte::detail::without_blanks(unquoted), at);
    }
    if (ends_open) take({}, rest.data());
    if (head) return;
    if (column != names_.size())
      throw kte::bad_file(place_in(text, line, text.data() + text.size()) + std::to_string(column) + " numbers for " +
                          std::to_string(names_.size()) + " columns");
    rows_.push_back(std::move(numbers)), lines_.push_back(line);
  }

  std::filesystem::path path_;
  std::map<std::string, std::size_t, std::less<>> names_;
  std::vector<std::vector<double>> rows_;
  std::vector<int> lines_;
};

}  // namespace evaluate
