#pragma once

#include <kte/io/source_text.hpp>
#include <kte/robots/detail/triangle_mesh.hpp>

#include <charconv>
#include <cmath>
#include <filesystem>

namespace kte::detail {

/// Whether a word equals `lower` regardless of case.
constexpr bool same_word(std::string_view word, std::string_view lower) {
  if (word.size() != lower.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if ((word[i] >= 'A' && word[i] <= 'Z' ? word[i] - 'A' + 'a' : word[i]) != lower[i]) return false;
  return true;
}

/// Reads the words of a text mesh line by line; all errors are `bad_file` with path and line.
class mesh_text {
 public:
  mesh_text(const std::filesystem::path& path, std::string_view text) : path_(path), rest_(text) {}

  int line() const { return line_; }
  [[noreturn]] void bad_at(int line, const std::string& what) const {
    raise<bad_file>("kte: " + path_.string() + ":" + std::to_string(line) + ": " + what);
  }
  [[noreturn]] void bad(const std::string& what) const { bad_at(line_, what); }

  /// The next word of this line; empty at its end. A backslash at the end of a line joins the next line.
  std::string_view word() {
    for (;;) {
      std::size_t n = 0;
      while (n < rest_.size() && rest_[n] != '\n' && is_blank(rest_[n])) ++n;
      rest_.remove_prefix(n);
      const std::size_t joined = rest_.starts_with("\\\n") ? 2 : rest_.starts_with("\\\r\n") ? 3 : 0;
      if (joined == 0) break;
      rest_.remove_prefix(joined), ++line_;
    }
    std::size_t n = 0;
    while (n < rest_.size() && !is_blank(rest_[n])) ++n;
    const auto w = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return w;
  }
  /// Goes to the next line; false at the end of the text.
  bool next_line() {
    const auto n = rest_.find('\n');
    if (n == rest_.npos) return rest_ = {}, false;
    rest_.remove_prefix(n + 1), ++line_;
    return true;
  }
  /// The next word on any line; empty at the end of the text.
  std::string_view next_word() {
    auto w = word();
    while (w.empty() && next_line()) w = word();
    return w;
  }

  /// The finite number of a word, with or without a sign.
  double number(std::string_view w, const char* what) const {
    double x = 0;
    const auto digits = w.starts_with('+') ? w.substr(1) : w;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    if (w.empty()) bad(std::string(what) + " is cut off");
    if (error == std::errc::result_out_of_range) bad("'" + excerpt(w) + "' is too large or too small for a double");
    if (error != std::errc{} || end != digits.data() + digits.size()) bad("'" + excerpt(w) + "' is not a number");
    if (!std::isfinite(x)) bad(std::string(what) + " is not finite");
    return x;
  }

 private:
  const std::filesystem::path& path_;
  std::string_view rest_;
  int line_ = 1;
};

}  // namespace kte::detail
