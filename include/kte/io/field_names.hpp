#pragma once

#include <kte/io/utf8.hpp>

/// Names in model files.
namespace kte::detail {

/// Why a name is not valid in a file, or nullptr.
constexpr const char* name_fault(std::string_view name) {
  if (name.empty()) return "is empty";
  for (std::size_t n = 0; !name.empty(); name.remove_prefix(n)) {
    n = utf8_length(name);
    if (n == 0) return "is not UTF-8";
    if (begins_with_control(name)) return "has a control character";
  }
  return nullptr;
}

/// The length of the tag name at the beginning of a text, or 0.
constexpr std::size_t tag_name_length(std::string_view text) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' || (c & 0x80) != 0;
  };
  std::size_t n = 0;
  while (n < text.size()) {
    const char c = text[n];
    if (!letter(c) && (n == 0 || !((c >= '0' && c <= '9') || c == '-' || c == '.'))) break;
    ++n;
  }
  return n;
}

}  // namespace kte::detail
