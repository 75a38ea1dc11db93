#pragma once

#include <kte/io/printable.hpp>

#include <set>
#include <string>
#include <string_view>

namespace kte::detail {

/// A name of letters, digits and single underscores: other characters become one underscore, or nothing at the ends,
/// and a leading digit gets the prefix `n`.
inline std::string plain_name(std::string_view name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  std::string s;
  for (const char c : name) {
    if (is_letter(c))
      s += c;
    else if (!s.empty() && s.back() != '_')
      s += '_';
  }
  if (!s.empty() && s.back() == '_') s.pop_back();
  if (s.empty() || (s[0] >= '0' && s[0] <= '9')) s.insert(0, "n");
  return s;
}

/// Unique names as C++ identifiers. They end with an underscore, unlike keywords, the names of this library and of std,
/// and known macros. If two names become equal, the later one gets a number.
class identifier_list {
 public:
  std::string make(std::string_view name) {
    const std::string s = plain_name(name);
    std::string unique = s + "_";
    for (int n = 2; !taken_.insert(unique).second; ++n) unique = s + "_" + std::to_string(n) + "_";
    return unique;
  }

 private:
  std::set<std::string> taken_;
};

/// The identifier of a robot: its name, with an underscore only if it is a keyword or a macro of C libraries.
inline std::string robot_identifier(std::string_view name) {
  static constexpr std::string_view words =
      " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t char8_t class"
      " co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue decltype"
      " default delete do double dynamic_cast else enum explicit export extern false float for friend goto if import"
      " inline int long module mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected"
      " public register reinterpret_cast requires return short signed sizeof static static_assert static_cast struct"
      " switch template this thread_local throw true try typedef typeid typename union unsigned using virtual void"
      " volatile wchar_t while xor xor_eq "
      " BIG_ENDIAN BUFSIZ DOMAIN EOF EXIT_FAILURE EXIT_SUCCESS HUGE_VAL INFINITY LITTLE_ENDIAN NAN NULL RAND_MAX"
      " assert errno far i386 interface linux major max min minor near small stderr stdin stdout unix ";
  std::string s = plain_name(name);
  if (s.starts_with("M_") || words.find(" " + s + " ") != words.npos) s += '_';
  return s;
}

/// A text as a C++ string literal.
inline std::string cpp_text(std::string_view text) {
  std::string s = "\"";
  while (!text.empty()) {
    const auto [code, bytes, valid] = first_character(text);
    const bool hidden = !valid || is_hidden(code);
    for (const char c : text.substr(0, bytes)) {
      if (hidden || c == '"' || c == '\\') s += '\\';
      if (!hidden) s += c;
      for (const int shift : {6, 3, 0})
        if (hidden) s += static_cast<char>('0' + ((static_cast<unsigned char>(c) >> shift) & 7));
    }
    text.remove_prefix(bytes);
  }
  return s + '"';
}

}  // namespace kte::detail
