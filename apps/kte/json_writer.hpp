#pragma once

#include <kte/io/printable.hpp>

#include <charconv>
#include <cmath>
#include <concepts>
#include <string>
#include <string_view>

namespace kte_tool {

/// A text in JSON, in the order in which it is written. Finite numbers have the shortest digits that read back to the
/// same double; others are null. Bytes that are not UTF-8 are U+FFFD, hidden characters are escaped.
class json_writer {
 public:
  json_writer& object() { return open('{', '}'); }
  json_writer& list() { return open('[', ']'); }
  json_writer& end() {
    text_ += closing_.back();
    closing_.pop_back(), first_ = false;
    return *this;
  }
  json_writer& key(std::string_view name) {
    separate();
    put_text(name);
    text_ += ':', first_ = true;
    return *this;
  }
  json_writer& value(std::string_view x) {
    separate();
    put_text(x);
    return *this;
  }
  json_writer& value(const char* x) { return value(std::string_view(x)); }
  json_writer& value(const std::string& x) { return value(std::string_view(x)); }
  json_writer& value(bool x) { return raw(x ? "true" : "false"); }
  json_writer& value(double x) {
    char digits[40];
    if (!std::isfinite(x)) return raw("null");
    return raw({digits, static_cast<std::size_t>(std::to_chars(digits, digits + sizeof digits, x).ptr - digits)});
  }
  template <std::integral X>
  json_writer& value(X x) {
    return raw(std::to_string(x));
  }
  /// A list of whatever there are values of.
  template <class List>
  requires requires(const List& l) { l.begin(), l.size(); }
  json_writer& value(const List& all) {
    list();
    for (const auto& x : all) value(x);
    return end();
  }
  template <class X>
  json_writer& member(std::string_view name, const X& x) {
    return key(name).value(x);
  }
  /// All of it, with a line's end.
  std::string text() const { return text_ + '\n'; }

 private:
  json_writer& open(char begin, char end) {
    separate();
    text_ += begin, closing_ += end, first_ = true;
    return *this;
  }
  json_writer& raw(std::string_view x) {
    separate();
    text_ += x;
    return *this;
  }
  void separate() {
    if (!first_) text_ += ',';
    first_ = false;
  }
  void put_text(std::string_view x) {
    text_ += '"';
    while (!x.empty()) {
      const auto c = kte::detail::first_character(x);
      if (!c.valid) {
        text_ += "\xEF\xBF\xBD";
      } else if (kte::detail::is_hidden(c.code)) {
        char escaped[8];
        std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(c.code));
        text_ += escaped;
      } else {
        if (c.code == '"' || c.code == '\\') text_ += '\\';
        text_ += x.substr(0, c.bytes);
      }
      x.remove_prefix(c.bytes);
    }
    text_ += '"';
  }

  std::string text_, closing_;
  bool first_ = true;
};

}  // namespace kte_tool
