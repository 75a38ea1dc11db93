#pragma once

#include <kte/io/field_scanner.hpp>
#include <kte/io/source_text.hpp>

#include <algorithm>
#include <utility>

namespace kte::detail {

/// Reads JSON: groups are objects, lists are arrays. (The parsers of cereal accept duplicates and report no positions.)
class json_scanner final : public field_scanner {
 public:
  explicit json_scanner(source_text& source) : source_(source), text_(source.text()) {}

  std::size_t at() const override { return at_; }

  void open_document() override { open('{', "a model must be an object {...}"); }
  void close_document() override {
    start();
    if (i_ != text_.size()) source_.fail(i_, "unexpected content after the end of the model");
  }
  void open_group(const std::string& what) override { open('{', "'" + what + "' must be an object {...}"); }
  void open_list(const std::string& what) override { open('[', "'" + what + "' must be a list [...]"); }
  bool next_field(std::string& name) override {
    if (!next('}')) return false;
    if (current() != '"') fail("expected a name in quotes");
    name = quoted();
    const auto colon = text_.find_first_not_of(" \t\r\n", i_);
    i_ = (std::min)(colon, text_.size());
    if (current() != ':') source_.fail(i_, "expected ':'");
    ++i_;
    return true;
  }
  bool next_item(std::size_t) override { return next(']'); }

  std::string text(const std::string& name) override {
    start();
    if (current() != '"') fail("'" + name + "' is not a text in quotes");
    return quoted();
  }
  /// Reads a text, a number or a list of numbers.
  std::string numbers(const std::string& name) override {
    start();
    if (current() == '"') return quoted();
    if (current() != '[') return number(name);
    const std::size_t first = at_;
    open_list(name);
    std::string all;
    while (next(']')) all += number(name) + ' ';
    at_ = first;
    return all;
  }
  file_place place(std::size_t offset) override { return source_.place(offset); }

 private:
  [[noreturn]] void fail(const std::string& why) {
    if (i_ == text_.size()) source_.fail_at_end();
    source_.fail(at_, why);
  }
  /// 0 at the end; no text contains it.
  char current() const { return i_ < text_.size() ? text_[i_] : '\0'; }
  void start() {
    while (is_blank(current())) ++i_;
    at_ = i_;
  }
  void open(char bracket, const std::string& rule) {
    start();
    if (current() != bracket) fail(rule);
    ++i_;
    first_ = true;
  }
  bool next(char bracket) {
    start();
    const bool first = std::exchange(first_, false);
    if (current() == bracket) {
      ++i_;
      return false;
    }
    if (first) return true;
    if (current() != ',') fail(std::string("expected ',' or '") + bracket + "'");
    ++i_;
    start();
    if (current() == bracket) fail("expected a value after the comma");
    return true;
  }
  std::string quoted() {
    std::string out;
    for (++i_; current() != '"'; ++i_) {
      const char c = current();
      if (c == '\\') {
        escape(out);
      } else if (c == '\0') {
        source_.fail_at_end();
      } else if (is_blank(c) && c != ' ') {
        source_.fail(i_, "a line end or tab within quotes");
      } else {
        out += c;
      }
    }
    ++i_;
    return out;
  }
  /// Ends on the last character of the escape.
  void escape(std::string& out) {
    static constexpr std::string_view names = "\"\\/nrt", stand_for = "\"\\/\n\r\t";
    const std::size_t from = i_++;
    if (current() == 'u') {
      char32_t c = four_digits(from);
      if (c >= 0xD800 && c < 0xDC00 && text_.substr(i_ + 1, 2) == "\\u") {
        i_ += 2;
        const char32_t low = four_digits(from);
        if (low < 0xDC00 || low > 0xDFFF) source_.fail(from, "this escape stands for no character");
        c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
      }
      return source_.append(out, c, from);
    }
    const auto known = names.find(current());
    if (known == names.npos) source_.fail(from, "this is not an escape of a text");
    out += stand_for[known];
  }
  char32_t four_digits(std::size_t from) {
    char32_t c = 0;
    for (int n = 0; n < 4; ++n) {
      const auto digit = std::string_view("0123456789abcdefABCDEF").find(text_.substr(++i_, 1));
      if (i_ >= text_.size()) source_.fail_at_end();
      if (digit == std::string_view::npos) source_.fail(from, "\\u needs four hexadecimal digits");
      c = 16 * c + static_cast<char32_t>(digit < 16 ? digit : digit - 6);
    }
    return c;
  }
  static bool is_of_number(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '+' ||
           c == '-' || c == '_';
  }
  std::string number(const std::string& name) {
    start();
    const auto bad = [&] { fail("'" + name + "' is neither a number, nor a text, nor a list of numbers"); };
    const auto digits = [&] {
      const std::size_t from = i_;
      while (current() >= '0' && current() <= '9') ++i_;
      if (i_ == from) bad();
    };
    if (current() == '-') ++i_;
    current() == '0' ? static_cast<void>(++i_) : digits();
    if (current() == '.') ++i_, digits();
    if (current() == 'e' || current() == 'E') {
      ++i_;
      if (current() == '+' || current() == '-') ++i_;
      digits();
    }
    if (is_of_number(current())) {  // 01, 0x1, 1.5.2
      while (is_of_number(current())) ++i_;
      fail("'" + name + "': '" + excerpt(text_.substr(at_, i_ - at_)) + "' is not a JSON number");
    }
    return std::string(text_.substr(at_, i_ - at_));
  }

  source_text& source_;
  std::string_view text_;
  std::size_t i_ = 0, at_ = 0;
  bool first_ = false;  ///< whether nothing of the innermost group or list has been read
};

}  // namespace kte::detail
