#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/detail/xml_limits.hpp>
#include <kte/robots/detail/xml_node.hpp>

#include <algorithm>
#include <filesystem>
#include <string_view>

/// Reading XML: the parts that do not depend on the XML library.
namespace kte::detail {

/// Reads the root of an XML file that another file refers to. Its elements know the name of the file.
using xml_parser = xml_node (*)(const std::filesystem::path&);

/// The path for a file name in the file of a robot, which may contain backslashes from Windows.
inline std::filesystem::path path_of_text(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

/// Whether a path is a regular file: no folder, device or pipe.
inline bool is_file(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

/// Throws `bad_file`: "kte: arm.urdf:37: why".
[[noreturn]] void fail_xml(const std::string& source, int line, const std::string& why);
/// Throws `bad_file`; "XML_ERROR_MISMATCHED_ELEMENT" becomes "mismatched element".
[[noreturn]] void fail_xml_syntax(const std::string& source, int line, const char* error);
/// The text without its byte order mark, of a URDF without what follows its end; throws `bad_file` unless it is UTF-8
/// and of acceptable size, and for elements of too many attributes.
std::string_view checked_text(std::string_view text, const std::string& source);
std::string text_of_file(const std::filesystem::path& path);
/// Sets the titles of all elements; throws `bad_file` for elements of xacro. Text that was cut off after the root
/// becomes an attribute, which is listed as not read.
void give_titles(xml_node& root, const std::string& source, bool is_cut);
/// Sets the file of an element and of all elements below it.
void give_file(xml_node& n, const std::string& file);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/io/file.hpp>
#  include <kte/io/source_text.hpp>
#  include <kte/robots/detail/shape_names.hpp>

#  include <array>

namespace kte::detail {
inline constexpr std::size_t largest_robot_file = std::size_t{1} << 28;
KTE_FUNCTION void fail_xml(const std::string& source, int line, const std::string& why) {
  raise<bad_file>("kte: " + place_text(source, line) + why);
}
KTE_FUNCTION void fail_xml_syntax(const std::string& source, int line, const char* error) {
  std::string why = error;
  constexpr std::pair<std::string_view, const char*> known[]{
      {"XML_ERROR_PARSING_ELEMENT", "a tag is not ended by >"},
      {"XML_ERROR_PARSING_ATTRIBUTE", "an attribute has no value in quotes, or occurs twice"},
      {"XML_ERROR_PARSING_TEXT", "a text stands outside of the elements, or is not ended by a tag"},
      {"XML_ERROR_PARSING_CDATA", "<![CDATA[ is not ended by ]]>"},
      {"XML_ERROR_PARSING_COMMENT", "a comment is not ended by -->"},
      {"XML_ERROR_PARSING_DECLARATION", "a declaration <?xml ...?> is not ended by ?>, or stands after an element"},
      {"XML_ERROR_PARSING_UNKNOWN", "<! is not ended by >"},
      {"XML_ERROR_MISMATCHED_ELEMENT", "mismatched element: its end tag is missing or has another name"},
      {"XML_ERROR_ELEMENT_DEPTH_EXCEEDED", "element depth exceeded"}};
  for (const auto& [name, text] : known)
    if (name == why) fail_xml(source, line, std::string("this is not valid XML: ") + text);
  why.erase(0, why.starts_with("XML_ERROR_") ? 10 : 4);
  for (char& c : why) c = c == '_' ? ' ' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  fail_xml(source, line, "this is not valid XML: " + why);
}
/// Refuses elements with too many attributes, for which XML libraries take a time that is quadratic in their number.
inline void check_attributes(std::string_view text, const std::string& source) {
  const auto skip = [&](std::size_t from, std::string_view end) {
    const auto at = text.find(end, from);
    return at == text.npos ? text.size() : at + end.size();
  };
  for (std::size_t i = text.find('<'); i < text.size(); i = text.find('<', i)) {
    const auto rest = text.substr(i);
    if (rest.starts_with("<!--") || rest.starts_with("<![CDATA[") || rest.starts_with("<?")) {
      i = skip(i, rest[1] == '?' ? "?>" : rest[2] == '-' ? "-->" : "]]>");
      continue;
    }
    std::size_t count = 0;
    const auto start = i;
    while (i < text.size() && text[i] != '>') {
      const char c = text[i++];
      count += c == '=';
      if (c == '"' || c == '\'') i = skip(i, {&c, 1});
    }
    if (count > most_attributes)
      fail_xml(source,
               1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(start), '\n')),
               "an element has more than " + std::to_string(most_attributes) + " attributes");
  }
}
/// The number of bytes that follow the end of a URDF and are neither elements nor comments. Readers of URDF ignore
/// them.
inline std::size_t bytes_after_robot(std::string_view text) {
  constexpr std::string_view close = "</robot>";
  const auto at = text.rfind(close);
  if (at == text.npos) return 0;
  const auto rest = text.substr(at + close.size());
  const auto first = rest.find_first_not_of(" \t\r\n");
  return first == rest.npos || rest[first] == '<' ? 0 : rest.size();
}
KTE_FUNCTION std::string_view checked_text(std::string_view text, const std::string& source) {
  if (text.size() > largest_robot_file)
    fail_xml(source, 1, "the file has more than " + std::to_string(largest_robot_file) + " bytes");
  text.remove_suffix(bytes_after_robot(text));
  text = source_text(text, source).text();
  check_attributes(text, source);
  return text;
}
KTE_FUNCTION std::string text_of_file(const std::filesystem::path& path) { return read_file(path, largest_robot_file); }

/// Sets the title of an element; `owner` is the title of the nearest named element above, for the root that of the
/// robot, or of the nearest of several shapes. A shape without a name gets its `place` among those of its link, from 1,
/// 0 for the only one: "link 'arm': second <visual>".
inline void give_title(xml_node& n, const std::string& source, const std::string& owner, bool top,
                       std::size_t place = 0) {
  if (n.name.starts_with("xacro:"))
    fail_xml(source, n.line,
             "<" + excerpt(n.name) +
                 ">: this is a file for xacro, not a robot yet: run xacro, and read the file that it writes");
  n.title = owner + (place > 0 ? ordinal(place) + " " : "") + "<" + excerpt(n.name) + ">";
  std::string below = place > 0 ? n.title + ": " : owner;
  for (const auto& [key, value] : n.attributes)
    if (key == "name") {
      n.title = excerpt(n.name) + " '" + excerpt(value) + "'";
      if (!top) below = n.title + ": ";
    }
  constexpr std::array<std::string_view, 3> shapes{"visual", "collision", "geom"};
  std::array<std::size_t, 3> count{}, seen{};
  const auto kind = [&](const xml_node& c) {
    return static_cast<std::size_t>(std::find(shapes.begin(), shapes.end(), c.name) - shapes.begin());
  };
  for (const auto& c : n.children)
    if (const auto k = kind(c); k < 3) ++count[k];
  for (auto& c : n.children) {
    const auto k = kind(c);
    give_title(c, source, below, false, k < 3 && count[k] > 1 ? ++seen[k] : 0);
  }
}
KTE_FUNCTION void give_titles(xml_node& root, const std::string& source, bool is_cut) {
  if (is_cut) root.attributes.emplace_back("text after </robot>", "");
  give_title(root, source, {}, true);
}
KTE_FUNCTION void give_file(xml_node& n, const std::string& file) {
  n.file = file;
  for (auto& c : n.children) give_file(c, file);
}
}  // namespace kte::detail
#endif
