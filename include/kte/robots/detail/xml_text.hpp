#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/detail/xml_limits.hpp>
#include <kte/robots/detail/xml_node.hpp>

#include <algorithm>
#include <filesystem>
#include <string_view>

/// Reading XML: the parts that do not depend on the XML library.
namespace kte::detail {

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
/// Sets the file of an element and of all elements below it.
void give_file(xml_node& n, const std::string& file);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/io/file.hpp>
#  include <kte/io/source_text.hpp>

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
/// The first place from `i` on that does not belong to what begins there, if that is a comment, a declaration or text
/// between CDATA brackets; otherwise `i`.
inline std::size_t after_comment(std::string_view text, std::size_t i) {
  const char mark = i + 1 < text.size() ? text[i + 1] : ' ';
  if (mark != '!' && mark != '?') return i;  // as most tags
  const auto rest = text.substr(i);
  const std::string_view end = mark == '?'                     ? "?>"
                               : rest.starts_with("<!--")      ? "-->"
                               : rest.starts_with("<![CDATA[") ? "]]>"
                                                               : "";
  if (end.empty()) return i;
  const auto at = text.find(end, i);
  return at == text.npos ? text.size() : at + end.size();
}
/// Refuses elements with too many attributes, for which XML libraries take a time that is quadratic in their number.
inline void check_attributes(std::string_view text, const std::string& source) {
  for (std::size_t i = text.find('<'); i < text.size(); i = text.find('<', i)) {
    if (const auto after = after_comment(text, i); after != i) {
      i = after;
      continue;
    }
    std::size_t count = 0;
    const auto start = i;
    for (char c; i < text.size() && (c = text[i]) != '>'; ++i) {
      if (c == '=') ++count;
      if (c == '"' || c == '\'') i = (std::min)(text.find(c, i + 1), text.size() - 1);
    }
    if (count > most_attributes)
      fail_xml(source,
               1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(start), '\n')),
               "an element has more than " + std::to_string(most_attributes) + " attributes");
  }
}
/// Whether the first element is <robot>.
inline bool is_urdf(std::string_view text) {
  auto i = text.find('<');
  while (i < text.size() && !text.substr(i).starts_with("<robot")) {
    const auto after = after_comment(text, i);
    if (after == i && !text.substr(i).starts_with("<!")) return false;
    i = text.find('<', (std::max)(i + 1, after));
  }
  return i < text.size();
}
/// The number of bytes that follow the end of a URDF and are neither elements nor comments. Readers of URDF ignore
/// them.
inline std::size_t bytes_after_robot(std::string_view text) {
  constexpr std::string_view close = "</robot>";
  if (!is_urdf(text)) return 0;
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
KTE_FUNCTION void give_file(xml_node& n, const std::string& file) {
  n.file = file;
  for (auto& c : n.children) give_file(c, file);
}
}  // namespace kte::detail
#endif
