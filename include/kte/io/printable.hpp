#pragma once

#include <kte/io/utf8.hpp>

#include <cstdio>
#include <string>

/// Texts with names from files, as messages show them.
namespace kte::detail {

/// A character of a text and its number of bytes. An invalid UTF-8 byte is U+FFFD.
struct text_character {
  char32_t code;
  std::size_t bytes;
  bool valid = true;
};
constexpr text_character first_character(std::string_view text) {
  const std::size_t n = utf8_length(text);
  if (n == 0) return {0xFFFD, 1, false};
  const auto byte = [text](std::size_t i) { return static_cast<char32_t>(static_cast<unsigned char>(text[i])); };
  char32_t c = n == 1 ? byte(0) : byte(0) & (0xFFu >> (n + 1));
  for (std::size_t i = 1; i < n; ++i) c = (c << 6) | (byte(i) & 0x3F);
  return {c, n};
}

/// Characters that do not show, and change how terminals and editors show others: control characters, separators of
/// lines and paragraphs, and marks, embeddings, overrides and isolates of the direction of text.
constexpr bool is_hidden(char32_t c) {
  const bool control = c < 0x20 || (c >= 0x7F && c < 0xA0), separator = c == 0x2028 || c == 0x2029;
  const bool turns =
      c == 0x61C || c == 0x200E || c == 0x200F || (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
  return control || separator || turns;
}

/// A text in which the bytes of hidden characters and of invalid UTF-8 are written as \x0A, so that they do
/// nothing to terminals, and a message is a line. Lists, whose lines begin with two blanks, stay.
inline std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    std::size_t plain = 0;  // characters of ASCII, as most of any text
    while (plain < text.size() && text[plain] >= ' ' && text[plain] < '\x7f') ++plain;
    out.append(text.substr(0, plain));
    text.remove_prefix(plain);
    if (text.empty()) break;
    const auto [code, bytes, valid] = first_character(text);
    const bool shown = valid && (!is_hidden(code) || text.starts_with("\n  "));
    if (shown) out.append(text.substr(0, bytes));
    for (const char c : shown ? std::string_view() : text.substr(0, bytes)) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\x%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out += escaped;
    }
    text.remove_prefix(bytes);
  }
  return out;
}

}  // namespace kte::detail
