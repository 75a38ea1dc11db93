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

}  // namespace kte
