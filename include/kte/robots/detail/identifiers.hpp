#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

namespace kte::detail {

/// Names as identifiers of C++, each once: what is no letter, digit or single underscore becomes one, and where two
/// become the same the later one has a number. Deterministic.
class identifier_list {
 public:
  /// Names that are taken besides the words of the language.
  explicit identifier_list(std::set<std::string> taken) : taken_(std::move(taken)) {}

  std::string make(std::string_view name) {
    std::string s = letters_of(name);
    if (s.empty() || (s[0] >= '0' && s[0] <= '9')) s.insert(0, "n");
    std::string unique = s;
    for (int n = 2; is_word(unique) || !taken_.insert(unique).second; ++n) unique = s + "_" + std::to_string(n);
    return unique;
  }

 private:
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }
  /// Neither doubled underscores nor ones at the ends: those names are the compiler's, or end like types here.
  static std::string letters_of(std::string_view name) {
    std::string s;
    for (const char c : name) {
      if (is_letter(c))
        s += c;
      else if (!s.empty() && s.back() != '_')
        s += '_';
    }
    if (!s.empty() && s.back() == '_') s.pop_back();
    return s;
  }
  /// Of the language, and what C libraries have as macros.
  static bool is_word(std::string_view s) {
    static constexpr std::array words = std::to_array<std::string_view>({"EOF",
                                                                         "INFINITY",
                                                                         "NAN",
                                                                         "NULL",
                                                                         "alignas",
                                                                         "alignof",
                                                                         "and",
                                                                         "and_eq",
                                                                         "asm",
                                                                         "assert",
                                                                         "auto",
                                                                         "bitand",
                                                                         "bitor",
                                                                         "bool",
                                                                         "break",
                                                                         "case",
                                                                         "catch",
                                                                         "char",
                                                                         "char16_t",
                                                                         "char32_t",
                                                                         "char8_t",
                                                                         "class",
                                                                         "co_await",
                                                                         "co_return",
                                                                         "co_yield",
                                                                         "compl",
                                                                         "concept",
                                                                         "const",
                                                                         "const_cast",
                                                                         "consteval",
                                                                         "constexpr",
                                                                         "constinit",
                                                                         "continue",
                                                                         "decltype",
                                                                         "default",
                                                                         "delete",
                                                                         "do",
                                                                         "double",
                                                                         "dynamic_cast",
                                                                         "else",
                                                                         "enum",
                                                                         "errno",
                                                                         "explicit",
                                                                         "export",
                                                                         "extern",
                                                                         "false",
                                                                         "float",
                                                                         "for",
                                                                         "friend",
                                                                         "goto",
                                                                         "if",
                                                                         "import",
                                                                         "inline",
                                                                         "int",
                                                                         "linux",
                                                                         "long",
                                                                         "major",
                                                                         "minor",
                                                                         "module",
                                                                         "mutable",
                                                                         "namespace",
                                                                         "new",
                                                                         "noexcept",
                                                                         "not",
                                                                         "not_eq",
                                                                         "nullptr",
                                                                         "operator",
                                                                         "or",
                                                                         "or_eq",
                                                                         "private",
                                                                         "protected",
                                                                         "public",
                                                                         "register",
                                                                         "reinterpret_cast",
                                                                         "requires",
                                                                         "return",
                                                                         "short",
                                                                         "signed",
                                                                         "sizeof",
                                                                         "static",
                                                                         "static_assert",
                                                                         "static_cast",
                                                                         "stderr",
                                                                         "stdin",
                                                                         "stdout",
                                                                         "struct",
                                                                         "switch",
                                                                         "template",
                                                                         "this",
                                                                         "thread_local",
                                                                         "throw",
                                                                         "true",
                                                                         "try",
                                                                         "typedef",
                                                                         "typeid",
                                                                         "typename",
                                                                         "union",
                                                                         "unix",
                                                                         "unsigned",
                                                                         "using",
                                                                         "virtual",
                                                                         "void",
                                                                         "volatile",
                                                                         "wchar_t",
                                                                         "while",
                                                                         "xor",
                                                                         "xor_eq"});
    return std::binary_search(words.begin(), words.end(), s);
  }

  std::set<std::string> taken_;
};

/// A text in quotes, as C++ has it.
inline std::string cpp_text(std::string_view text) {
  std::string s = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      (s += '\\') += c;
    } else if (code < 32 || code == 127) {
      s += '\\';
      for (const int shift : {6, 3, 0}) s += static_cast<char>('0' + ((code >> shift) & 7));
    } else {
      s += c;
    }
  }
  return s + '"';
}

}  // namespace kte::detail
