#pragma once

#include <kte/detail/raise.hpp>
#include <kte/errors.hpp>
#include <kte/io/numbers.hpp>
#include <kte/io/utf8.hpp>
#include <kte/math/vec.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace kte::detail {

/// Throws `bad_argument` for texts that XML cannot represent.
inline void check_for_xml(std::string_view text) {
  for (auto rest = text; !rest.empty();) {
    const auto n = utf8_length(rest);
    if (n == 0) raise<bad_argument>("kte: the text '" + std::string(text) + "' is not UTF-8, and XML cannot hold it");
    if (begins_with_control(rest) && rest[0] != '\n' && rest[0] != '\t' && rest[0] != '\r')
      raise<bad_argument>("kte: the text '" + std::string(text) + "' has a control character, which XML cannot hold");
    rest.remove_prefix(n);
  }
}

/// Writes XML, indented by two spaces per level.
class xml_writer {
 public:
  void open(std::string_view name) {
    start(name);
    names_.emplace_back(name), is_open_ = true;
  }
  /// The number of elements that are open.
  std::size_t depth() const { return names_.size(); }
  void attribute(std::string_view key, std::string_view value) {
    check_for_xml(value);
    text_.append(" ").append(key).append("=\"");
    for (const char c : value) {
      if (c == '&')
        text_ += "&amp;";
      else if (c == '<')
        text_ += "&lt;";
      else if (c == '"')
        text_ += "&quot;";
      else if (c == '\n' || c == '\t' || c == '\r')
        text_ += "&#" + std::to_string(static_cast<int>(c)) + ";";
      else
        text_ += c;
    }
    text_ += '"';
  }
  void attribute(std::string_view key, const std::vector<double>& numbers) {
    attribute(key, std::string_view(numbers_to_text(numbers)));
  }
  void attribute(std::string_view key, double x) { attribute(key, std::vector<double>{x}); }
  void attribute(std::string_view key, const vec3<>& v) { attribute(key, std::vector<double>{v.x, v.y, v.z}); }
  void close() {
    const auto name = std::move(names_.back());
    names_.pop_back();
    if (is_open_)
      text_ += "/>\n";
    else
      text_.append(2 * names_.size(), ' ').append("</").append(name).append(">\n");
    is_open_ = false;
  }
  /// Writes an element with attributes only.
  template <class Value>
  void leaf(std::string_view name, std::string_view key, const Value& value) {
    open(name), attribute(key, value), close();
  }
  /// Writes an element with a word or numbers as its text, without characters reserved by XML.
  void text(std::string_view name, std::string_view word) {
    start(name);
    text_.append(">").append(word).append("</").append(name).append(">\n");
    is_open_ = false;
  }
  /// Adds a comment in front of all elements.
  void comment(std::string_view text) {
    check_for_xml(text);
    comments_ += "<!-- ";
    for (const char c : text) {
      if (c == '-' && comments_.back() == '-') comments_ += ' ';  // two would end the comment
      comments_ += c;
    }
    comments_ += " -->\n";
  }
  std::string take() { return "<?xml version=\"1.0\"?>\n" + std::move(comments_) + std::move(text_); }

 private:
  void start(std::string_view name) {
    if (is_open_) text_ += ">\n";
    text_.append(2 * names_.size(), ' ').append("<").append(name);
  }
  std::string text_, comments_;
  std::vector<std::string> names_;
  bool is_open_ = false;
};

}  // namespace kte::detail
