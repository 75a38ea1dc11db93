#pragma once

#include <kte/robots/description.hpp>

#include <iterator>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>

namespace kte::detail {

/// "first" to "tenth", "11.", "12." and so on.
inline std::string ordinal(std::size_t n) {
  static constexpr const char* words[]{"first", "second",  "third",  "fourth", "fifth",
                                       "sixth", "seventh", "eighth", "ninth",  "tenth"};
  return n >= 1 && n <= std::size(words) ? words[n - 1] : std::to_string(n) + ".";
}

/// What shapes are called in messages: "shape 'hull'", or without a name by their place among the shapes of their link
/// that have the same form: "second visual box"; the only one is the "visual box".
class shape_names {
 public:
  /// Adds the shapes of a link, in order. They and the name of the link must stay.
  void add(std::string_view link, const robot_shape& s, bool collision) {
    auto& count = counts_[{link, collision, s.is}];
    places_[&s] = {&count, ++count, collision};
  }
  explicit shape_names(const robot_description& d) {
    for (const auto& l : d.links) {
      for (const auto& s : l.visuals) add(l.name, s, false);
      for (const auto& s : l.collisions) add(l.name, s, true);
    }
  }
  shape_names() = default;

  std::string of(const robot_shape& s) const {
    if (!s.name.empty()) return "shape '" + s.name + "'";
    static constexpr const char* forms[]{"shape",     "box",   "cylinder", "capsule",     "sphere",
                                         "ellipsoid", "plane", "mesh",     "height field"};
    const auto& x = places_.at(&s);
    return (*x.count > 1 ? ordinal(x.number) + " " : "") + (x.collision ? "collision " : "visual ") +
           forms[static_cast<std::size_t>(s.is)];
  }

 private:
  struct place {
    const std::size_t* count;  ///< of the shapes of this form
    std::size_t number;
    bool collision;
  };
  std::map<std::tuple<std::string_view, bool, robot_shape::form>, std::size_t> counts_;
  std::unordered_map<const robot_shape*, place> places_;
};

}  // namespace kte::detail
