#pragma once

#include <kte/errors.hpp>

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

/// Numbers as text that reads back as the same bits, whatever the locale.
namespace kte::detail {

/// "0 0 -9.81": the shortest digits that give the same doubles.
inline std::string numbers_to_text(const std::vector<double>& values) {
  std::string s;
  char digits[40];
  for (const double x : values) {
    const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
    if (!s.empty()) s += ' ';
    s.append(digits, end);
  }
  return s;
}

/// The reverse. Throws `bad_file` for anything that is not just numbers with blanks between them.
inline std::vector<double> text_to_numbers(std::string_view text) {
  std::vector<double> values;
  const char* p = text.data();
  const char* const end = p + text.size();
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  for (;;) {
    while (p != end && blank(*p)) ++p;
    if (p == end) return values;
    double x{};
    const auto [next, error] = std::from_chars(p, end, x);
    if (error != std::errc{} || (next != end && !blank(*next)))
      throw bad_file("'" + std::string(text.substr(0, 80)) + "' is not a list of numbers");
    values.push_back(x);
    p = next;
  }
}

}  // namespace kte::detail
