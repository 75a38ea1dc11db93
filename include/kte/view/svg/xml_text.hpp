#pragma once

#include <kte/io/utf8.hpp>

/// Arbitrary bytes as XML text.
namespace kte::detail::svg {

/// A character of a text and its number of bytes. An invalid UTF-8 byte is U+FFFD.
struct text_character {
  char32_t code;
  std::size_t bytes;
};
constexpr text_character first_character(std::string_view text) {
  const std::size_t n = utf8_length(text);
  if (n == 0) return {0xFFFD, 1};
  const auto byte = [text](std::size_t i) { return static_cast<char32_t>(static_cast<unsigned char>(text[i])); };
  char32_t c = n == 1 ? byte(0) : byte(0) & (0xFFu >> (n + 1));
  for (std::size_t i = 1; i < n; ++i) c = (c << 6) | (byte(i) & 0x3F);
  return {c, n};
}

/// Characters that XML does not permit, and characters that change the direction of the surrounding text.
constexpr bool is_unprintable(char32_t c) {
  const bool control = c < 0x20 || (c >= 0x7F && c < 0xA0), none = (c & 0xFFFE) == 0xFFFE;
  const bool turns = c == 0x200E || c == 0x200F || (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
  return control || none || turns || c == 0x2028 || c == 0x2029;
}

/// A text in UTF-8 on one line: blanks for tabs and line ends, U+FFFD for characters that cannot be shown.
inline std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto [code, bytes] = first_character(text);
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
