#pragma once

#include <kte/errors.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace kte {

namespace detail {

[[noreturn]] inline void raise_file(const char* action, const std::filesystem::path& path, int code) {
  raise<bad_file>(std::string("kte: cannot ") + action + " '" + path.string() + "': " + std::strerror(code));
}

struct close_file {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using file = std::unique_ptr<std::FILE, close_file>;

inline file open_file(const std::filesystem::path& path, const char* mode) {
  file f(std::fopen(path.string().c_str(), mode));
  if (!f) raise_file("open", path, errno);
  return f;
}

inline constexpr std::string_view blanks = " \t\r\n\v\f";

}  // namespace detail

/// Writes a text file of numbers: a line of column names, then one line a row, all separated by single spaces. Numbers
/// have the fewest digits that give the same number when read again (`std::to_chars`).
///
///   kte::table_writer out("run.txt", {"t", "theta", "omega"});
///   solver.integrate(10.0, kte::every(0.01), [&](double t, const auto& x) { out.row(t, x); });
///   out.close();
///
/// Rows go through a buffer; no row allocates. Throws `bad_file` with the path and the reason where the file cannot be
/// opened or written, at the latest in `close`. The destructor writes what is left and says nothing.
class table_writer {
 public:
  /// Throws `bad_argument` for no names, or one that is empty, has a blank or occurs twice.
  table_writer(const std::filesystem::path& path, const std::vector<std::string>& names)
      : path_(path), columns_(names.size()) {
    if (names.empty()) detail::raise<bad_argument>("kte: a table needs a column");
    for (auto n = names.begin(); n != names.end(); ++n) {
      if (n->empty()) detail::raise<bad_argument>("kte: a column of a table has no name");
      if (n->find_first_of(detail::blanks) != std::string::npos)
        detail::raise<bad_argument>("kte: the column name '" + *n + "' has a blank");
      if (std::find(names.begin(), n, *n) != n) detail::raise<bad_argument>("kte: two columns are named '" + *n + "'");
    }
    file_ = detail::open_file(path, "wb");
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
    buffer_.reserve(capacity);
    for (const auto& n : names) put(n);
    buffer_.back() = '\n';
  }
  table_writer(const table_writer&) = delete;
  table_writer& operator=(const table_writer&) = delete;
  ~table_writer() {
    if (file_) std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get());
  }

  /// A row of numbers and vectors of numbers, as many as there are columns; else throws `bad_argument`.
  template <class... T>
  void row(const T&... values) {
    const std::size_t n = (std::size_t{0} + ... + count(values));
    if (n != columns_) [[unlikely]]
      detail::raise<bad_argument>("kte: a row of " + std::to_string(n) + " numbers in a table of " +
                                  std::to_string(columns_) + " columns: '" + path_.string() + "'");
    (put(values), ...);
    buffer_.back() = '\n';
  }
  /// Hands the rows so far to the operating system.
  void flush() {
    if (!file_) detail::raise<bad_file>("kte: cannot write '" + path_.string() + "': it is closed");
    errno = 0;
    if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size()) {
      const int code = errno;
      file_.reset();
      detail::raise_file("write", path_, code);
    }
    buffer_.clear();
  }
  /// Writes what is left and closes the file. Does nothing the second time.
  void close() {
    if (!file_) return;
    flush();
    if (std::fclose(file_.release()) != 0) detail::raise_file("close", path_, errno);
  }

 private:
  static constexpr std::size_t capacity = 1 << 16;

  template <class T>
  static std::size_t count(const T& x) {
    if constexpr (std::is_arithmetic_v<T>) {
      return 1;
    } else {
      return static_cast<std::size_t>(x.size());
    }
  }
  template <class T>
  void put(const T& x) {
    if constexpr (std::is_arithmetic_v<T>) {
      char text[64];
      put(std::string_view(text, static_cast<std::size_t>(std::to_chars(text, text + sizeof text, x).ptr - text)));
    } else {
      for (decltype(x.size()) i = 0; i < x.size(); ++i) put(x[i]);
    }
  }
  void put(std::string_view word) {
    if (!file_ || (!buffer_.empty() && buffer_.size() + word.size() + 1 > capacity)) flush();
    buffer_.append(word).push_back(' ');
  }
  void put(const std::string& word) { put(std::string_view(word)); }

  std::filesystem::path path_;
  std::size_t columns_;
  detail::file file_;
  std::string buffer_;
};

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
