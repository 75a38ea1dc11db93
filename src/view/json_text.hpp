#pragma once

#include <kte/io/utf8.hpp>

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace kte::view {

/// Writes JSON: objects and lists with their commas. A text that may stand in a page: `<` and what ends lines in
/// scripts is escaped.
class json_text {
 public:
  void open_object() { begin('{'); }
  void open_list() { begin('['); }
  void close_object() { end('}'); }
  void close_list() { end(']'); }
  void key(std::string_view name) {
    text(name);
    out_ += ':', first_ = true;
  }
  /// Invalid UTF-8 becomes U+FFFD.
  void text(std::string_view x) {
    comma();
    out_ += '"';
    while (!x.empty()) {
      const auto n = detail::utf8_length(x);
      put_character(x.substr(0, n));
      x.remove_prefix(n == 0 ? 1 : n);
    }
    out_ += '"';
  }
  /// Numbers that are not finite become null.
  template <std::floating_point Number>
  void number(Number x) {
    comma();
    if (!std::isfinite(x)) {
      out_ += "null";
      return;
    }
    char digits[32];
    out_.append(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
  }
  void number(std::integral auto x) { word(std::to_string(x)); }
  void boolean(bool x) { word(x ? "true" : "false"); }
  void null() { word("null"); }
  /// JSON text, unchanged.
  void raw(std::string_view json) { word(json); }
  /// Bytes as base64, least significant first.
  template <class Number>
  void numbers_in_base64(std::span<const Number> x) {
    comma();
    out_ += '"';
    put_base64(reinterpret_cast<const unsigned char*>(x.data()), x.size_bytes());
    out_ += '"';
  }
  template <class List>
  void list(const List& x) {
    open_list();
    for (const auto& each : x) number(each);
    close_list();
  }

  std::string& out() { return out_; }

 private:
  void comma() {
    if (!first_) out_ += ',';
    first_ = false;
  }
  void begin(char bracket) {
    comma();
    out_ += bracket, first_ = true;
  }
  void end(char bracket) { out_ += bracket, first_ = false; }
  void word(std::string_view x) {
    comma();
    out_ += x;
  }
  void put_character(std::string_view c) {
    if (c.empty()) {
      out_ += "\xEF\xBF\xBD";
    } else if (c == "\"" || c == "\\") {
      out_ += '\\', out_ += c;
    } else if (c == "\xE2\x80\xA8") {
      out_ += "\\u2028";
    } else if (c == "\xE2\x80\xA9") {
      out_ += "\\u2029";
    } else if (c == "<" || detail::begins_with_control(c)) {
      static constexpr char digits[] = "0123456789abcdef";
      const auto code = static_cast<unsigned char>(c.back());  // of U+0080 to U+009F the last byte, too
      out_ += "\\u00", out_ += digits[code >> 4], out_ += digits[code & 15];
    } else {
      out_ += c;
    }
  }
  void put_base64(const unsigned char* bytes, std::size_t n) {
    static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    out_.reserve(out_.size() + (n + 2) / 3 * 4 + 2);
    std::size_t i = 0;
    const auto put = [&](unsigned bits, int characters) {
      for (int k = 0; k < 4; ++k) out_ += k < characters ? letters[bits >> (18 - 6 * k) & 63] : '=';
    };
    for (; i + 3 <= n; i += 3) put(unsigned{bytes[i]} << 16 | unsigned{bytes[i + 1]} << 8 | bytes[i + 2], 4);
    if (n - i == 1) put(unsigned{bytes[i]} << 16, 2);
    if (n - i == 2) put(unsigned{bytes[i]} << 16 | unsigned{bytes[i + 1]} << 8, 3);
  }

  std::string out_;
  bool first_ = true;
};

}  // namespace kte::view
