#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Suggestions for misspelt names.
namespace kte::detail {

/// The number of letters that must be inserted, deleted, changed, or exchanged with the next one to convert a to b: the
/// optimal string alignment distance. Names of more than 63 letters have a larger distance.
constexpr std::size_t edit_distance(std::string_view a, std::string_view b) {
  constexpr std::size_t most = 63;
  if (a.size() > most || b.size() > most) return most;
  std::array<std::array<std::size_t, most + 1>, 3>
      row{};  // distances for one letter of a each: this one, the last, and the one before
  for (std::size_t j = 0; j <= b.size(); ++j) row[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    auto &now = row[i % 3], &last = row[(i + 2) % 3], &before = row[(i + 1) % 3];
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      now[j] = (std::min)((std::min)(last[j], now[j - 1]) + 1, last[j - 1] + (same ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = (std::min)(now[j], before[j - 2] + 1);
    }
  }
  return row[a.size() % 3][b.size()];
}
/// The index of the known name that a misspelt name may mean, or the number of names if there is none. It is the
/// nearest name, if at most a third of its letters, or one letter, differ.
template <class Names>
constexpr std::size_t nearest_name(std::string_view written, const Names& known) {
  std::size_t best = known.size(), least = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::string_view name = known[i];
    const std::size_t longer = (std::max)(name.size(), written.size()), shorter = name.size() + written.size() - longer;
    const std::size_t most = (std::max)(longer / 3, std::size_t{1});
    if (longer < 2 || longer - shorter > most) continue;
    const std::size_t d = edit_distance(written, name);
    if (d <= most && (best == known.size() || d < least)) best = i, least = d;
  }
  return best;
}
/// The end of a message: ", did you mean 'elbow'?", or empty.
inline std::string did_you_mean(std::string_view written, const std::vector<std::string>& known) {
  const std::size_t i = nearest_name(written, known);
  return i == known.size() ? std::string() : ", did you mean '" + known[i] + "'?";
}
/// The first eight: "there are 'base', 'elbow'", "there are none".
inline std::string list_of_names(const std::vector<std::string>& known) {
  if (known.empty()) return "there are none";
  std::string text = "there are ";
  for (std::size_t i = 0; i < known.size() && i < 8; ++i)
    text.append(i == 0 ? "'" : ", '").append(known[i]).append("'");
  return known.size() > 8 ? text + " and " + std::to_string(known.size() - 8) + " more" : text;
}

}  // namespace kte::detail
