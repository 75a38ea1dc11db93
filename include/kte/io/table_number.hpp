#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

/// Numbers of tables as text in any locale.
namespace kte::detail {

/// Appends x with the fewest digits that read back to the same double, always with a point or an exponent: `1.0`,
/// `-2.5e-17`, `nan`, `inf`. `no_exponent`: `0.000025`, up to 344 characters.
inline void append_table_number(std::string& out, double x, bool no_exponent = false) {
  if (std::isnan(x)) {  // to_chars would write its sign
    out += "nan";
    return;
  }
  char text[400];
  char* const last = text + sizeof text;
  const char* const end =
      no_exponent ? std::to_chars(text, last, x, std::chars_format::fixed).ptr : std::to_chars(text, last, x).ptr;
  const std::string_view digits(text, static_cast<std::size_t>(end - text));
  out += digits;
  if (digits.find_first_not_of("-0123456789") == digits.npos) out += ".0";
}

/// Reads a number; returns whether it is the whole text.
inline bool read_number(std::string_view text, double& x) {
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, x);
  return code == std::errc{} && stop == end;
}

}  // namespace kte::detail
