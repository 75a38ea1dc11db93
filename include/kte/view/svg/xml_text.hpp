#pragma once

#include <kte/io/printable.hpp>

/// Arbitrary bytes as XML text.
namespace kte::detail::svg {

/// Characters that XML does not permit, and hidden ones.
constexpr bool is_unprintable(char32_t c) { return is_hidden(c) || (c & 0xFFFE) == 0xFFFE; }

/// A text in UTF-8 on one line: blanks for tabs and line ends, U+FFFD for characters that cannot be shown.
inline std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto [code, bytes, valid] = first_character(text);
    const bool blank = code == '\t' || code == '\n' || code == '\r';
    append_utf8(out, blank ? U' ' : is_unprintable(code) ? char32_t{0xFFFD} : code);
    text.remove_prefix(bytes);
  }
  return out;
}

/// Appends a text such that XML readers return its `printable`, within elements and within quoted attributes.
inline void append_xml(std::string& out, std::string_view text) {
  for (const char c : printable(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
}

}  // namespace kte::detail::svg
