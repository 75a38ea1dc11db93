#pragma once

#include <kte/contract/file_place.hpp>
#include <kte/errors.hpp>
#include <kte/io/text_encoding.hpp>
#include <kte/io/utf8.hpp>

#include <algorithm>
#include <limits>

namespace kte::detail {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The beginning of a text, short enough for a message.
inline std::string excerpt(std::string_view text) { return std::string(text.substr(0, 80)); }

/// Rejects a file with more bytes than `read_options` allows.
inline std::string file_too_large(std::size_t max_bytes) {
  return "the file has more than " + std::to_string(max_bytes) + " bytes (read_options::max_bytes)";
}

/// The text of a model file, with positions. Throws `bad_file` unless it is UTF-8 without control characters.
class source_text {
 public:
  /// `name` is the name of the file in messages; the text must outlive this object.
  source_text(std::string_view text, std::string name, std::size_t max_bytes = ~std::size_t{0})
      : text_(without_mark(text)), file_(std::make_shared<const std::string>(std::move(name))) {
    if (text.size() > max_bytes) fail(0, file_too_large(max_bytes));
    if (const char* why = other_encoding(text)) fail(0, why);
    bool empty = true;
    for (std::size_t i = 0, n = 0; i < text_.size(); i += n) {
      if (text_[i] > ' ' && text_[i] < '\x7f') {  // as most of any file
        n = 1, empty = false;
        continue;
      }
      n = utf8_length(text_.substr(i));
      if (n == 0) fail(i, "this is not UTF-8");
      if (is_blank(text_[i])) continue;
      empty = false;
      if (const char* why = control_fault(text_.substr(i, n))) fail(i, std::string("here is ") + why);
    }
    if (empty) fail(0, "the file is empty");
  }

  std::string_view text() const { return text_; }

  /// Fast for positions in ascending order.
  file_place place(std::size_t offset) {
    if (offset < offset_) offset_ = 0, line_ = column_ = 1;
    for (; offset_ < offset && offset_ < text_.size(); ++offset_) {
      if (text_[offset_] == '\n') {
        ++line_, column_ = 1;
      } else if ((text_[offset_] & 0xC0) != 0x80) {  // counts characters, not bytes
        ++column_;
      }
    }
    constexpr std::size_t largest = (std::numeric_limits<int>::max)();
    return {file_, static_cast<int>((std::min)(line_, largest)), static_cast<int>((std::min)(column_, largest))};
  }
  [[noreturn]] void fail(std::size_t offset, const std::string& why) {
    raise<bad_file>("kte: " + to_string(place(offset)) + why);
  }
  [[noreturn]] void fail_at_end() { fail(text_.size(), "the file ends in the middle of the model"); }

  /// Appends the character of an escape at `offset`.
  void append(std::string& out, char32_t c, std::size_t offset) {
    if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) fail(offset, "this escape stands for no character");
    std::string character;
    append_utf8(character, c);
    if (const char* why = control_fault(character)) fail(offset, std::string("this escape stands for ") + why);
    out += character;
  }

 private:
  static const char* control_fault(std::string_view character) {
    if (character[0] == '\0') return "a zero byte";
    return begins_with_control(character) && !is_blank(character[0]) ? "a control character" : nullptr;
  }

  std::string_view text_;
  std::shared_ptr<const std::string> file_;
  std::size_t offset_ = 0, line_ = 1, column_ = 1;
};

}  // namespace kte::detail
