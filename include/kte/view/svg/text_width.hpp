#pragma once

#include <kte/view/svg/xml_text.hpp>

#include <iterator>
#include <vector>

/// Widths of texts, for layouts. They are estimates, because fonts differ.
namespace kte::detail::svg {

/// The width of a character in units of the font size, for a wide sans-serif font; ideographs and symbols are squares.
constexpr double character_width(char32_t c) {
  constexpr short ascii[]{// thousandths, from the blank to the tilde
                          318,  401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337,
                          636,  636, 636, 636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531,
                          1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787,
                          603,  787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500,
                          500,  613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612,
                          635,  635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838};
  static_assert(std::size(ascii) == 95);
  if (c >= 0x20 && c < 0x7F) return ascii[c - 0x20] / 1000.0;
  if (c >= 0x0300 && c < 0x0370) return 0;  // combining marks
  return c < 0x1100 ? 0.7 : c == 0x2212 ? 0.84 : 1.0;
}
inline double text_width(std::string_view text) {
  double w = 0;
  while (!text.empty()) {
    const auto [code, bytes, valid] = first_character(text);
    w += character_width(code), text.remove_prefix(bytes);
  }
  return w;
}

/// A text that fits into `room`, in units of the font size. In longer texts the middle is replaced by "…", because the
/// ends of column names state the quantity.
inline std::string shortened(std::string_view text, double room) {
  std::string whole = printable(text);
  if (text_width(whole) <= room) return whole;
  std::vector<std::string_view> characters;
  for (std::string_view rest = whole; !rest.empty();) {
    characters.push_back(rest.substr(0, first_character(rest).bytes));
    rest.remove_prefix(characters.back().size());
  }
  std::string head, tail;
  double left = room - 1;
  for (std::size_t i = 0; i < characters.size() / 2; ++i) {
    for (const bool end : {true, false}) {
      const auto c = characters[end ? characters.size() - 1 - i : i];
      left -= text_width(c);
      if (left < 0) return head + "…" + tail;
      if (end)
        tail.insert(0, c);
      else
        head += c;
    }
  }
  return head + "…" + tail;
}

}  // namespace kte::detail::svg
