#pragma once

#include <random>
#include <string>
#include <string_view>

namespace kte::live {

/// 128 random bits of the system, in hexadecimal digits.
inline std::string random_token() {
  static constexpr char digits[] = "0123456789abcdef";
  std::random_device source;
  std::string text;
  for (int word = 0; word < 4; ++word)
    for (unsigned bits = source(), i = 0; i < 8; ++i, bits >>= 4) text += digits[bits & 15];
  return text;
}

/// Whether a text is the token, in a time that depends on neither.
inline bool same_token(std::string_view token, std::string_view text) {
  unsigned difference = token.size() == text.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i)
    difference |= static_cast<unsigned char>(token[i]) ^
                  static_cast<unsigned>(i < text.size() ? static_cast<unsigned char>(text[i]) : 0);
  return difference == 0;
}

}  // namespace kte::live
