#pragma once

#include <kte/io/field_names.hpp>
#include <kte/io/source_text.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace kte::detail {

/// Reads an XML text as `json_scanner` reads JSON, in the form that cereal writes: all within <cereal>; fields are
/// tags, items of lists are <value0>, <value1> ... or just <value>. Comments may stand between fields and around
/// values. There are no attributes but size="dynamic" on a list, and xml:space on a value; DOCTYPE is refused, as it
/// could change what the rest means.
class xml_scanner {
 public:
  explicit xml_scanner(source_text& source) : source_(source), text_(source.text()) {}

  std::size_t at() const { return at_; }

  void open_document() {
    if (here("<?xml") && is_blank(peek(5))) skip_past("?>");
    std::string name;
    if (!next_tag(name) || name != "cereal") source_.fail(at_, "a model file begins with <cereal>");
    open_group(name);
  }
  void close_document() {
    skip_between();
    if (i_ != text_.size()) source_.fail(i_, "something follows the end of the model");
  }
  void open_group(const std::string& what) { check_attributes(what); }
  void open_list(const std::string& what) {
    if (take_attribute("size").value_or("dynamic") != "dynamic")
      source_.fail(at_, "the size of '" + what + "' must be \"dynamic\"");
    check_attributes(what);
  }
  bool next_field(std::string& name) {
    if (next_tag(name)) return true;
    close();
    return false;
  }
  bool next_item(std::size_t number) {
    std::string name;
    if (!next_field(name)) return false;
    if (const auto due = "value" + std::to_string(number); name != "value" && name != due)
      source_.fail(at_, "<" + due + "> or <value> is due, not <" + excerpt(name) + ">");
    return true;
  }

  /// The text of a field, without blanks around it unless xml:space="preserve".
  std::string text(const std::string& name) {
    const auto space = take_attribute("xml:space").value_or("default");
    if (space != "preserve" && space != "default") source_.fail(at_, "xml:space must be \"preserve\" or \"default\"");
    check_attributes(name);
    std::string out;
    at_ = i_;
    closed_ ? close() : read_value(name, out);
    if (space == "preserve") return out;
    const auto first = std::min(out.find_first_not_of(blank), out.size());
    return out.substr(first, out.find_last_not_of(blank) + 1 - first);
  }
  std::string numbers(const std::string& name) { return text(name); }

 private:
  struct attribute {
    std::string_view name, value;
    std::size_t at;
  };
  static constexpr std::string_view blank = " \t\r\n";

  char peek(std::size_t ahead = 0) const { return i_ + ahead < text_.size() ? text_[i_ + ahead] : '\0'; }
  bool here(std::string_view token) const { return text_.substr(i_).starts_with(token); }
  [[noreturn]] void fail(const std::string& why) {
    if (i_ == text_.size()) source_.fail_at_end();
    source_.fail(i_, why);
  }
  /// Gives what is before the token.
  std::string_view skip_past(std::string_view token) {
    const auto end = text_.find(token, i_);
    if (end == text_.npos) source_.fail_at_end();
    const auto before = text_.substr(i_, end - i_);
    i_ = end + token.size();
    return before;
  }
  bool skip_blanks() {
    const std::size_t from = i_;
    i_ = std::min(text_.find_first_not_of(blank, i_), text_.size());
    return i_ != from;
  }
  /// Skips a comment or a processing instruction, if here is one.
  bool skip_remark() {
    if (here("<!--")) {
      i_ += 4;
      skip_past("--");
      if (peek() != '>') fail("'--' must not stand within a comment");
      ++i_;
    } else if (here("<?")) {
      i_ += 2;
      if (const auto target = name(); target == "xml") fail("the declaration of XML belongs at the start");
      skip_past("?>");
    } else {
      return false;
    }
    return true;
  }
  void skip_between() {
    while (skip_blanks() || skip_remark()) {
    }
  }
  std::string_view name() {
    const std::size_t n = tag_name_length(text_.substr(i_)), from = i_;
    if (n == 0) fail("a name is due here");
    i_ += n;
    return text_.substr(from, n);
  }

  /// The next tag that starts, within the innermost open one; false where that ends.
  bool next_tag(std::string& tag) {
    if (closed_) return false;
    skip_between();
    at_ = i_;
    if (here("</")) return false;
    if (peek() != '<') fail("a tag is due here, not text");
    if (here("<!DOCTYPE")) fail("a model file has no DOCTYPE");
    if (here("<!")) fail("a tag is due here");
    ++i_;
    tag = name();
    open_.push_back(tag);
    attributes_.clear();
    while (skip_blanks() && peek() != '/' && peek() != '>') read_attribute();
    closed_ = peek() == '/';
    if (closed_) ++i_;
    if (peek() != '>') fail("'>' is due here");
    ++i_;
    return true;
  }
  /// The end of the innermost open tag.
  void close() {
    if (!std::exchange(closed_, false)) {
      i_ += 2;
      if (name() != open_.back()) source_.fail(at_, "</" + open_.back() + "> is due here");
      skip_blanks();
      if (peek() != '>') fail("'>' is due here");
      ++i_;
    }
    open_.pop_back();
  }
  void read_attribute() {
    const std::size_t from = i_;
    const auto key = name();
    if (key != "size" && key != "xml:space")
      source_.fail(from, "'" + open_.back() + "' has an unknown attribute '" + excerpt(key) + "'");
    skip_blanks();
    if (peek() != '=') fail("'=' is due here");
    ++i_, skip_blanks();
    const char quote = peek();
    if (quote != '"' && quote != '\'') fail("a quote is due here");
    ++i_;
    const auto value = skip_past({&quote, 1});
    if (value.find('<') != value.npos) source_.fail(from, "'<' must not stand within an attribute");
    for (const auto& a : attributes_)
      if (a.name == key) source_.fail(from, "a second attribute '" + std::string(key) + "'");
    attributes_.push_back({key, value, from});
  }
  std::optional<std::string_view> take_attribute(std::string_view key) {
    const auto a = std::find_if(attributes_.begin(), attributes_.end(), [key](const auto& x) { return x.name == key; });
    if (a == attributes_.end()) return {};
    at_ = a->at;
    const auto value = a->value;
    attributes_.erase(a);
    return value;
  }
  void check_attributes(const std::string& what) {
    for (const auto& a : attributes_)
      source_.fail(a.at, "'" + what + "' has no attribute '" + std::string(a.name) + "'");
  }
  /// Up to the end of the innermost open tag. `at_` is then where the text begins.
  void read_value(const std::string& tag, std::string& out) {
    bool begun = false, interrupted = false;
    const auto put = [&](std::size_t from, auto&& append) {
      const std::size_t before = out.size();
      append();
      if (out.find_first_not_of(blank, before) == out.npos) return;
      if (interrupted) source_.fail(from, "the text of '" + tag + "' goes on behind a comment");
      if (!std::exchange(begun, true)) at_ = from;
    };
    for (;;) {
      const std::size_t from = i_;
      if (here("</")) {
        const std::size_t start = std::exchange(at_, i_);
        close();
        at_ = start;
        return;
      }
      if (here("<![CDATA[")) {
        i_ += 9;
        put(from, [&] { out += skip_past("]]>"); });
      } else if (skip_remark()) {
        interrupted = begun;
      } else if (peek() == '<') {
        fail("'" + tag + "' holds a text, not tags");
      } else if (peek() == '&') {
        put(from, [&] { entity(out); });
      } else if (i_ == text_.size()) {
        source_.fail_at_end();
      } else if (!skip_blanks_into(out)) {
        put(from, [&] {
          const auto end = std::min(text_.find_first_of(" \t\r\n<&", i_), text_.size());
          out += text_.substr(i_, end - i_);
          i_ = end;
        });
      }
    }
  }
  bool skip_blanks_into(std::string& out) {
    const std::size_t from = i_;
    if (!skip_blanks()) return false;
    out += text_.substr(from, i_ - from);
    return true;
  }
  void entity(std::string& out) {
    const std::size_t from = i_++, end = text_.find_first_of("; \t\r\n<&", i_);
    const auto name = end == text_.npos || text_[end] != ';' ? "" : text_.substr(i_, end - i_);
    i_ += name.size() + 1;
    if (name.starts_with('#')) return source_.append(out, character(name.substr(1), from), from);
    static constexpr std::pair<std::string_view, char> known[]{
        {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
    const auto* const k =
        std::find_if(std::begin(known), std::end(known), [&](const auto& x) { return x.first == name; });
    if (k == std::end(known)) source_.fail(from, "'&' begins no known entity (for itself write &amp;)");
    out += k->second;
  }
  /// Of a reference, "233" or "xE9".
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
  std::size_t i_ = 0, at_ = 0;
  bool closed_ = false;  ///< whether the tag read last was <so/>
  std::vector<std::string> open_;
  std::vector<attribute> attributes_;
};

}  // namespace kte::detail
