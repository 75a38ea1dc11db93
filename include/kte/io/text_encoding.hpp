#pragma once

#include <cstddef>
#include <string_view>

namespace kte::detail {

/// Which other encoding than UTF-8 a text has, as a sentence: by its byte order mark, or because every other of its
/// first bytes is zero, as UTF-16 has it for letters of ASCII. Null if it may be UTF-8.
constexpr const char* other_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv))
    return "this is UTF-32, and kte reads UTF-8: save the file as UTF-8";
  const auto zero = [text](std::size_t i) { return text[i] == '\0'; };
  const bool every_other = text.size() > 3 && zero(0) != zero(1) && zero(0) == zero(2) && zero(1) == zero(3);
  return every_other || text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")
             ? "this is UTF-16, and kte reads UTF-8: save the file as UTF-8"
             : nullptr;
}

}  // namespace kte::detail
