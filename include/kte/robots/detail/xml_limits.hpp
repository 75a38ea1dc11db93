#pragma once

#include <cstddef>

/// What files of robots may have at most, so that a small file takes little memory, stack and time.
namespace kte::detail {

/// Elements within each other, with those of included files.
inline constexpr int deepest_element = 500;
/// Elements that including, repeating and attaching make.
inline constexpr std::size_t most_elements = 300000;
/// Attributes of one element, which are compared with each other.
inline constexpr std::size_t most_attributes = 1000;

}  // namespace kte::detail
