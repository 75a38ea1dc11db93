#pragma once

#include <kte/io/field_scanner.hpp>
#include <kte/io/xml_cursor.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace kte::detail {

/// XML in the form that cereal writes: all within <cereal>; fields are tags, list items are <value0>, <value1> ... or
/// <value>. Comments may stand between fields and around values. The only attributes are size="dynamic" on lists and
/// xml:space on values. DOCTYPE is refused, because it could change the meaning of the rest.
class xml_scanner final : public field_scanner {
 public:
  explicit xml_scanner(source_text& source) : source_(source), in_(source) {}

  std::size_t at() const override { return at_; }

  void open_document() override {
    if (in_.here("<?xml") && is_blank(in_.peek(5))) declaration();
    std::string name;
    if (!next_tag(name) || name != "cereal") in_.fail_at(at_, "a model file begins with <cereal>");
    open_group(name);
  }
  void close_document() override {
    in_.skip_between();
    if (!in_.at_end()) in_.fail("unexpected content after the end of the model");
  }
  void open_group(const std::string& what) override { check_attributes(what); }
  void open_list(const std::string& what) override {
    if (take_attribute("size").value_or("dynamic") != "dynamic")
      in_.fail_at(at_, "the size of '" + what + "' must be \"dynamic\"");
    check_attributes(what);
  }
  bool next_field(std::string& name) override {
    if (next_tag(name)) return true;
    close();
    return false;
  }
  bool next_item(std::size_t number) override {
    std::string name;
    if (!next_field(name)) return false;
    if (const auto due = "value" + std::to_string(number); name != "value" && name != due)
      in_.fail_at(at_, "expected <" + due + "> or <value>, got <" + excerpt(name) + ">");
    return true;
  }

  /// The text of a field, without blanks around it unless xml:space="preserve".
  std::string text(const std::string& name) override {
    const auto space = take_attribute("xml:space").value_or("default");
    if (space != "preserve" && space != "default") in_.fail_at(at_, "xml:space must be \"preserve\" or \"default\"");
    check_attributes(name);
    std::string out;
    at_ = in_.offset();
    if (!closed_) read_value(name, out);
    close();
    if (space == "preserve") return out;
    const auto first = (std::min)(out.find_first_not_of(blank), out.size());
    return out.substr(first, out.find_last_not_of(blank) + 1 - first);
  }
  std::string numbers(const std::string& name) override { return text(name); }
  file_place place(std::size_t offset) override { return source_.place(offset); }

 private:
  struct attribute {
    std::string_view name, value;
    std::size_t at;
  };
  static constexpr std::string_view blank = " \t\r\n";

  void declaration() {
    in_.skip(5);
    while (!in_.blanks().empty() && in_.peek() != '?') read_attribute("xml", {"version", "encoding", "standalone"});
    in_.expect('?');
    in_.expect('>');
    if (!take_attribute("version").value_or("").starts_with("1.")) in_.fail_at(at_, "the version of XML must be 1.0");
    if (const auto code = take_attribute("encoding").value_or("utf-8"); code != "utf-8" && code != "UTF-8")
      in_.fail_at(at_, "the encoding must be UTF-8");
  }
  /// The next start tag within the innermost open tag; false at its end.
  bool next_tag(std::string& tag) {
    if (closed_) return false;
    in_.skip_between();
    at_ = in_.offset();
    if (in_.here("</")) return false;
    if (in_.peek() != '<') in_.fail("expected a tag, got text");
    if (in_.here("<!DOCTYPE")) in_.fail("a model file has no DOCTYPE");
    if (in_.here("<!")) in_.fail("expected a tag");
    in_.skip(1);
    tag = in_.name();
    open_.push_back(tag);
    attributes_.clear();
    while (!in_.blanks().empty() && in_.peek() != '/' && in_.peek() != '>') read_attribute(tag, {"size", "xml:space"});
    closed_ = in_.peek() == '/';
    if (closed_) in_.skip(1);
    in_.expect('>');
    return true;
  }
  /// The end of the innermost open tag.
  void close() {
    if (!std::exchange(closed_, false)) {
      const std::size_t from = in_.offset();
      in_.skip(2);
      if (in_.name() != open_.back()) in_.fail_at(from, "expected </" + open_.back() + ">");
      in_.blanks();
      in_.expect('>');
    }
    open_.pop_back();
  }
  void read_attribute(const std::string& what, std::initializer_list<std::string_view> known) {
    const std::size_t from = in_.offset();
    const auto key = in_.name();
    if (std::find(known.begin(), known.end(), key) == known.end())
      in_.fail_at(from, "'" + what + "' has an unknown attribute '" + excerpt(key) + "'");
    in_.blanks();
    in_.expect('=');
    in_.blanks();
    const char quote = in_.peek();
    if (quote != '"' && quote != '\'') in_.fail("expected a quote");
    in_.skip(1);
    const auto value = in_.skip_past({&quote, 1});
    for (const auto& a : attributes_)
      if (a.name == key) in_.fail_at(from, "a second attribute '" + std::string(key) + "'");
    attributes_.push_back({key, value, from});
  }
  std::optional<std::string_view> take_attribute(std::string_view key) {
    for (auto a = attributes_.begin(); a != attributes_.end(); ++a) {
      if (a->name != key) continue;
      at_ = a->at;
      const auto value = a->value;
      attributes_.erase(a);
      return value;
    }
    return {};
  }
  void check_attributes(const std::string& what) {
    for (const auto& a : attributes_)
      in_.fail_at(a.at, "'" + what + "' has no attribute '" + std::string(a.name) + "'");
  }
  /// Skips to the end of the innermost open tag; `at_` becomes the beginning of its text.
  void read_value(const std::string& tag, std::string& out) {
    bool begun = false, interrupted = false;
    while (!in_.here("</")) {
      if (in_.skip_remark()) {
        interrupted = begun;
        continue;
      }
      const std::size_t from = in_.offset(), before = out.size();
      if (in_.here("<![CDATA[")) {
        in_.skip(9);
        out += in_.skip_past("]]>");
      } else if (in_.peek() == '&') {
        in_.entity(out);
      } else if (in_.peek() == '<' || in_.at_end()) {
        in_.fail("'" + tag + "' holds a text, not tags");
      } else if (const auto gap = in_.blanks(); !gap.empty()) {
        out += gap;
        continue;
      } else {
        out += in_.until(" \t\r\n<&");
      }
      if (out.find_first_not_of(blank, before) == out.npos) continue;
      if (interrupted) in_.fail_at(from, "the text of '" + tag + "' goes on behind a comment");
      if (!std::exchange(begun, true)) at_ = from;
    }
  }

  source_text& source_;
  xml_cursor in_;
  std::size_t at_ = 0;
  bool closed_ = false;  ///< whether the last tag was <so/>
  std::vector<std::string> open_;
  std::vector<attribute> attributes_;
};

}  // namespace kte::detail
