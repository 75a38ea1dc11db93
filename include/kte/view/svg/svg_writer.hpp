#pragma once

#include <kte/view/svg/decimals.hpp>
#include <kte/view/svg/xml_text.hpp>

#include <vector>

namespace kte::detail::svg {

/// Writes XML elements, well-formed for any text:
///
///   out.begin("text").set("x", 1.5).text("a < b").end();
///
/// Tags and attribute names must be literals.
class svg_writer {
 public:
  svg_writer& begin(const char* tag) {
    end_start();
    if (std::string_view(tag) != "tspan") out_ += '\n';  // blanks within a text would be visible
    out_.append("<").append(tag);
    open_.emplace_back(tag), in_start_ = true;
    return *this;
  }
  svg_writer& set(const char* name, std::string_view value) {
    out_.append(" ").append(name).append("=\"");
    append_xml(out_, value);
    out_ += '"';
    return *this;
  }
  svg_writer& set(const char* name, double value) { return set(name, std::string_view(decimal(value))); }
  svg_writer& text(std::string_view content) {
    end_start();
    append_xml(out_, content);
    return *this;
  }
  svg_writer& end() {
    if (in_start_)
      out_ += "/>";
    else
      out_.append("</").append(open_.back()).append(">");
    open_.pop_back(), in_start_ = false;
    return *this;
  }
  /// An element that contains only a text.
  svg_writer& element(const char* tag, std::string_view content) { return begin(tag).text(content).end(); }

  /// The whole document, after all elements have ended.
  std::string document() const { return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>" + out_ + "\n"; }

 private:
  void end_start() {
    if (in_start_) out_ += '>';
    in_start_ = false;
  }

  std::string out_;
  std::vector<const char*> open_;
  bool in_start_ = false;
};

/// The root element of a picture with this width and height in mm, on white, with a description for screen readers.
inline void begin_picture(svg_writer& out, double width, double height, std::string_view font, double font_size,
                          std::string_view title, std::string_view description) {
  out.begin("svg").set("xmlns", "http://www.w3.org/2000/svg").set("version", "1.1");
  out.set("width", decimal(width) + "mm").set("height", decimal(height) + "mm");
  out.set("viewBox", "0 0 " + decimal(width) + " " + decimal(height));
  out.set("font-family", font).set("font-size", font_size).set("fill", "none").set("stroke-linecap", "round");
  out.set("stroke-linejoin", "round");
  out.element("title", title).element("desc", description);
  out.begin("rect").set("width", width).set("height", height).set("fill", "#fff").end();
}

}  // namespace kte::detail::svg
