#pragma once

#include <string_view>

namespace kte::view {

/// How an element is drawn.
enum class drawn {
  joint,
  link,  ///< a line from the frame that it reads to the frame that it writes
  body,
  base,  ///< by its frame alone
  force,
  pull,    ///< by a live page: not at all
  unknown  ///< an element that is none of the library's
};
struct element_kind {
  std::string_view stem;  ///< its type without _gen, _2D, _3D
  drawn as;
  std::string_view kind;  ///< of joints and forces in scenes
};

/// The kind of an element type.
element_kind kind_of_element(std::string_view type);

}  // namespace kte::view
