#pragma once

#include <cstdint>
#include <string_view>

/// The bytes of a binary model file, least significant first, equal on every machine:
///
///   file     magic, value                       the value is a group
///   value    tag, then by the tag
///     end      nothing                          after the fields of a group and the items of a list
///     group    pairs of a name and a value, end; names are texts
///     list     values, end
///     text     count, bytes of UTF-8
///     known    index of one of the file's texts of at most `longest_known` bytes, from 0
///     numbers  count, 8 bytes of IEEE 754 each
///   count    7 bits a byte, the lowest first; all bytes but the last have bit 7 set
namespace kte::detail {

/// No text begins like this, and transfers that change line ends are detected.
inline constexpr std::string_view binary_magic{"\x89kte\r\n\x1a\n", 8};

enum class binary_tag : unsigned char { end, group, list, text, known, numbers };

/// Longer texts are repeated in full, which limits the memory that a file can claim relative to its size.
inline constexpr std::size_t longest_known = 64;

}  // namespace kte::detail
