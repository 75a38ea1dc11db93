#pragma once

#include <kte/io/field_names.hpp>
#include <kte/io/source_text.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace kte::detail {

/// A position in an XML text that advances token by token. Throws `bad_file` with the position.
class xml_cursor {
 public:
  explicit xml_cursor(source_text& source) : source_(source), text_(source.text()) {}

  std::size_t offset() const { return i_; }
  bool at_end() const { return i_ == text_.size(); }
  /// 0 at the end; no text contains it.
  char peek(std::size_t ahead = 0) const { return i_ + ahead < text_.size() ? text_[i_ + ahead] : '\0'; }
  bool here(std::string_view token) const { return text_.substr(i_).starts_with(token); }

  [[noreturn]] void fail(const std::string& why) {
    if (at_end()) source_.fail_at_end();
    source_.fail(i_, why);
  }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& why) { source_.fail(offset, why); }

  void skip(std::size_t n) { i_ += n; }
  void expect(char c) {
    if (peek() != c) fail(std::string("expected '") + c + "'");
    ++i_;
  }
  /// Returns the text before the token.
  std::string_view skip_past(std::string_view token) {
    const auto end = text_.find(token, i_);
    if (end == text_.npos) source_.fail_at_end();
    const auto before = text_.substr(i_, end - i_);
    i_ = end + token.size();
    return before;
  }
  /// The text before the first of the characters, or all of it.
  std::string_view until(std::string_view characters) {
    const auto part = text_.substr(i_, text_.find_first_of(characters, i_) - i_);
    i_ += part.size();
    return part;
  }
  std::string_view blanks() {
    const auto part = text_.substr(i_, (std::min)(text_.find_first_not_of(" \t\r\n", i_), text_.size()) - i_);
    i_ += part.size();
    return part;
  }
  /// Skips a comment or processing instruction at the present position; returns whether there was one.
  bool skip_remark() {
    if (here("<!--")) {
      skip(4);
      skip_past("--");
      if (peek() != '>') fail("'--' must not stand within a comment");
      skip(1);
    } else if (here("<?")) {
      skip(2);
      if (name() == "xml") fail("the declaration of XML belongs at the start");
      skip_past("?>");
    } else {
      return false;
    }
    return true;
  }
  void skip_between() {
    while (!blanks().empty() || skip_remark()) {
    }
  }
  std::string_view name() {
    const auto n = tag_name_length(text_.substr(i_)), from = i_;
    if (n == 0) fail("expected a name");
    skip(n);
    return text_.substr(from, n);
  }
  /// Appends the character of an entity such as "&lt;" or "&#xE9;".
  void entity(std::string& out) {
    static constexpr std::pair<std::string_view, char> known[]{
        {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
    const std::size_t from = i_++;
    const auto part = until("; \t\r\n<&");
    const auto* const k =
        std::find_if(std::begin(known), std::end(known), [part](const auto& x) { return x.first == part; });
    const bool numeric = part.starts_with('#');
    if (peek() != ';' || (!numeric && k == std::end(known)))
      source_.fail(from, "'&' begins no known entity (write &amp; for the character itself)");
    skip(1);
    numeric ? source_.append(out, character(part.substr(1), from), from) : out.push_back(k->second);
  }

 private:
  /// The character of a reference, "233" or "xE9".
  char32_t character(std::string_view digits, std::size_t from) {
    const int base = digits.starts_with('x') ? 16 : 10;
    if (base == 16) digits.remove_prefix(1);
    std::uint32_t code{};
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, code, base);
    if (error != std::errc{} || stop != end) source_.fail(from, "this escape stands for no character");
    return code;
  }

  source_text& source_;
  std::string_view text_;
  std::size_t i_ = 0;
};

}  // namespace kte::detail
