#pragma once

#include <kte/io/utf8.hpp>

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// XML that was written, read strictly: what XML 1.0 does not allow is an error.
namespace kte::test {

struct svg_element {
  std::string tag, text;  ///< all text within it, also of its elements
  std::map<std::string, std::string> attributes;
  std::vector<svg_element> children;

  std::string operator[](const std::string& attribute) const {
    const auto a = attributes.find(attribute);
    return a == attributes.end() ? "" : a->second;
  }
  double number(const std::string& attribute) const { return std::stod((*this)[attribute]); }
  /// All elements of a tag within it.
  std::vector<const svg_element*> all(const std::string& wanted) const {
    std::vector<const svg_element*> found;
    const std::function<void(const svg_element&)> visit = [&](const svg_element& e) {
      if (e.tag == wanted) found.push_back(&e);
      for (const auto& c : e.children) visit(c);
    };
    visit(*this);
    return found;
  }
  /// The texts of all elements of a tag within it.
  std::vector<std::string> texts(const std::string& wanted) const {
    std::vector<std::string> found;
    for (const auto* e : all(wanted)) found.push_back(e->text);
    return found;
  }
};

class svg_reader {
 public:
  explicit svg_reader(std::string_view text) : text_(text) {}
  svg_element root() {
    expect("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    blanks();
    auto e = element();
    blanks();
    if (i_ != text_.size()) fail("something behind the root");
    return e;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(what + " at byte " + std::to_string(i_) + ": " + std::string(text_.substr(i_, 40)));
  }
  bool here(std::string_view s) const { return text_.substr(i_).starts_with(s); }
  void expect(std::string_view s) {
    if (!here(s)) fail("'" + std::string(s) + "' is due");
    i_ += s.size();
  }
  void blanks() {
    while (i_ < text_.size() && (text_[i_] == ' ' || text_[i_] == '\n')) ++i_;
  }
  std::string name() {
    const auto from = i_;
    while (i_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[i_])) != 0 || text_[i_] == '-')) ++i_;
    if (i_ == from) fail("a name is due");
    return std::string(text_.substr(from, i_ - from));
  }
  std::string characters(char end) {
    std::string out;
    while (i_ < text_.size() && text_[i_] != end) {
      if (text_[i_] == '<') fail("a bare '<'");
      if (text_[i_] == '&') {
        static constexpr std::pair<std::string_view, char> known[]{
            {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}};
        bool any = false;
        for (const auto& [entity, c] : known)
          if (!any && here(entity)) out += c, i_ += entity.size(), any = true;
        if (!any) fail("a bare '&'");
        continue;
      }
      const auto n = detail::utf8_length(text_.substr(i_));
      const auto c = static_cast<unsigned char>(text_[i_]);
      if (n == 0 || (c < 0x20 && c != '\n') || here("\xEF\xBF\xBE") || here("\xEF\xBF\xBF"))
        fail("no character of XML");
      out.append(text_.substr(i_, n)), i_ += n;
    }
    return out;
  }
  svg_element element() {
    expect("<");
    svg_element e;
    e.tag = name();
    for (blanks(); !here(">") && !here("/>"); blanks()) {
      const auto attribute = name();
      expect("=\"");
      if (!e.attributes.emplace(attribute, characters('"')).second) fail("an attribute that comes twice");
      expect("\"");
    }
    if (here("/>")) {
      i_ += 2;
      return e;
    }
    expect(">");
    while (!here("</")) {
      if (here("<")) {
        e.children.push_back(element());
        e.text += e.children.back().text;
      } else {
        e.text += characters('<');
        if (i_ == text_.size()) fail("an element that does not end");
      }
    }
    expect("</" + e.tag + ">");
    return e;
  }

  std::string_view text_;
  std::size_t i_ = 0;
};
/// Throws where it is not well-formed, or no picture.
inline svg_element read_svg(const std::string& text) {
  auto root = svg_reader(text).root();
  if (root.tag != "svg" || root["xmlns"] != "http://www.w3.org/2000/svg" || root["version"] != "1.1" ||
      root.children.size() < 2 || root.children[0].tag != "title" || root.children[1].tag != "desc")
    throw std::runtime_error("no picture with a title and a description");
  return root;
}

}  // namespace kte::test
