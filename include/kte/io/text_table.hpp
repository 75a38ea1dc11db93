#pragma once

#include <kte/io/file.hpp>
#include <kte/io/table.hpp>
#include <kte/io/table_number.hpp>
#include <kte/io/text_encoding.hpp>
#include <kte/io/utf8.hpp>

#include <span>

namespace kte::detail {

/// A table as text: a line of column names, then one line per row.
///
/// Suited to PlotJuggler: no number looks like an integer, and the first row, from which the column types are guessed,
/// has no exponents.
class text_table {
 public:
  explicit text_table(char separator) : separator_(separator) {}

  void head(const std::vector<std::string>& names, std::string& out) const {
    for (const auto& n : names) out.append(n).push_back(separator_);
    out.back() = '\n';
  }
  void row(std::span<const double> numbers, std::string& out) {
    for (const double x : numbers) {
      append_table_number(out, x, first_);
      out.push_back(separator_);
    }
    out.back() = '\n';
    first_ = false;
  }
  void tail(std::string&) const {}

 private:
  char separator_;
  bool first_ = true;
};

inline std::string_view without_blanks(std::string_view text) {
  text.remove_prefix((std::min)(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Removes the first cell and its separator from a line. A space stands for any number of blanks; other separators
/// separate exactly one cell.
inline std::string_view next_cell(std::string_view& line, char separator) {
  const auto end = (std::min)(separator == ' ' ? line.find_first_of(blanks) : line.find(separator), line.size());
  const auto cell = line.substr(0, end);
  line.remove_prefix((std::min)(end + 1, line.size()));
  if (separator != ' ') return without_blanks(cell);
  line = without_blanks(line);
  return cell;
}

/// Reads a cell in quotes, which may hold separators, and two quotes for one; `text` stores it. Returns false if the
/// closing quote does not end the cell.
inline bool next_quoted_cell(std::string_view& line, char separator, std::string& text) {
  text.clear();
  for (;;) {
    const auto quote = line.find('"', 1);
    text += line.substr(1, quote - 1);
    line.remove_prefix((std::min)(quote, line.size()));
    if (!line.starts_with("\"\"")) break;
    text += '"';
    line.remove_prefix(1);
  }
  if (line.empty()) return false;
  line.remove_prefix(1);
  return without_blanks(next_cell(line, separator)).empty();
}

/// Reads a table from a text; cells may be quoted. Throws `bad_file` with the path, line and column, counted from 1,
/// also for a text that ends within a line.
inline table read_text_table(const std::filesystem::path& path, std::string_view text, char separator) {
  std::size_t line = 0, column = 0;
  std::string_view cell;
  std::string quoted;
  const auto bad = [&](const std::string& what) {
    raise<bad_file>("kte: '" + path.string() + "', line " + std::to_string(line) + what);
  };
  const auto bad_cell = [&](const char* what) {
    bad(", column " + std::to_string(column + 1) + ": '" + std::string(cell.substr(0, 80)) + "' " + what);
  };
  if (const char* why = other_encoding(text)) raise<bad_file>("kte: '" + path.string() + "': " + why);
  text = without_mark(text);
  table t;
  known_names known;
  const auto name = [&] {
    if (cell.empty()) bad_cell("is not a name");
    if (!known.add(cell)) bad_cell("is there twice");
    t.names.emplace_back(cell);
    t.columns.emplace_back();
  };
  const auto number = [&] {
    double x{};
    if (column == t.names.size()) bad_cell("is one too many");
    if (!read_number(cell, x)) bad_cell("is not a number");
    t.columns[column].push_back(x);
  };
  while (++line == 1 || !text.empty()) {
    const auto end = text.find('\n');
    if (end == text.npos) bad(text.empty() ? ": no column names" : ": no line end, the file is cut off");
    auto rest = text.substr(0, end);
    if (const auto zero = rest.find('\0'); zero != rest.npos)
      bad(": here is a zero byte, after " + std::to_string(zero) + " bytes of the line");
    rest = without_blanks(rest);
    text.remove_prefix(end + 1);
    const bool ends_open = separator != ' ' && rest.ends_with(separator);  // the last cell is empty
    for (column = 0; !rest.empty(); ++column) {
      rest.remove_prefix((std::min)(rest.find_first_not_of(' '), rest.size()));
      if (rest.starts_with('"')) {
        const bool whole = next_quoted_cell(rest, separator, quoted);
        cell = quoted;
        if (!whole) bad_cell("does not end at its closing quote");
      } else {
        cell = next_cell(rest, separator);
      }
      line == 1 ? name() : number();
    }
    if (ends_open) {
      cell = {};
      line == 1 ? name() : number();
      ++column;
    }
    if (t.names.empty()) bad(": no column names");
    if (column != t.names.size())
      bad(": " + std::to_string(column) + " numbers for " + std::to_string(t.names.size()) + " columns");
  }
  return t;
}

}  // namespace kte::detail
