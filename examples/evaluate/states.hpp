#pragma once

#include <kte/io/file.hpp>
#include <kte/io/table_number.hpp>
#include <kte/io/text_table.hpp>

#include <cmath>
#include <map>

/// Tables of states: a line of column names, then a line of numbers a state, with commas between them.
namespace evaluate {

/// A table by the names of its columns. Errors name file, line and column, in characters from 1.
class state_table {
 public:
  explicit state_table(const std::filesystem::path& path) : path_(path) {
    const std::string bytes = kte::detail::read_file(path);
    std::string_view text = kte::detail::without_mark(bytes);
    for (int line = 1; !text.empty(); ++line) {
      const auto end = std::min(text.find('\n'), text.size());
      read_line(text.substr(0, end), line);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (names_.empty()) throw kte::bad_file("kte: " + path.string() + ": has no line of column names");
  }

  std::size_t rows() const { return rows_.size(); }
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
  void read_line(std::string_view text, int line) {
    const std::string_view whole = text;
    if (kte::detail::without_blanks(text).empty()) return;
    const bool head = names_.empty();
    std::vector<double> numbers;
    std::size_t column = 0;
    for (bool more = true; more; ++column) {
      const auto comma = text.find(',');
      more = comma != text.npos;
      auto cell = kte::detail::without_blanks(text.substr(0, comma));
      const auto at = [&, cell] {
        const auto before = static_cast<std::size_t>((cell.empty() ? text : cell).data() - whole.data());
        return "kte: " + path_.string() + ":" + std::to_string(line) + ":" + std::to_string(before + 1) + ": ";
      };
      if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
      const auto quoted = "'" + std::string(cell.substr(0, 80)) + "'";
      if (head) {
        if (!names_.emplace(cell, column).second) throw kte::bad_file(at() + "a second column " + quoted);
      } else {
        double x{};
        if (column == names_.size())
          throw kte::bad_file(at() + "more numbers than the " + std::to_string(names_.size()) + " columns");
        if (!kte::detail::read_number(cell.starts_with('+') ? cell.substr(1) : cell, x))
          throw kte::bad_file(at() + quoted + " is not a number");
        if (!std::isfinite(x)) throw kte::bad_file(at() + quoted + " is not a finite number");
        numbers.push_back(x);
      }
      text.remove_prefix(more ? comma + 1 : text.size());
    }
    if (head) return;
    if (column != names_.size())
      throw kte::bad_file("kte: " + path_.string() + ":" + std::to_string(line) + ":" +
                          std::to_string(whole.size() + 1) + ": " + std::to_string(column) + " numbers for " +
                          std::to_string(names_.size()) + " columns");
    rows_.push_back(std::move(numbers)), lines_.push_back(line);
  }

  std::filesystem::path path_;
  std::map<std::string, std::size_t, std::less<>> names_;
  std::vector<std::vector<double>> rows_;
  std::vector<int> lines_;
};

}  // namespace evaluate
