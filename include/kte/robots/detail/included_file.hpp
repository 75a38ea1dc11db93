#pragma once

#include <kte/robots/detail/xml_item.hpp>
#include <kte/robots/detail/xml_parser.hpp>
#include <kte/robots/detail/xml_text.hpp>

namespace kte::detail {

/// The root of the file to which an element refers. Its elements know the name of the file. Throws `bad_file`: of the
/// element if the file cannot be opened, of the file if it is not valid.
inline xml_node included_file(const xml_item& x, const std::filesystem::path& path, xml_parser parse) {
  std::string text;
  try {
    text = text_of_file(path);
  } catch (const bad_file& e) {
    x.fail(std::string(e.what()).substr(std::string_view("kte: ").size()));
  }
  auto root = parsed(text, path.string(), parse);
  give_file(root, path.string());
  return root;
}

}  // namespace kte::detail
