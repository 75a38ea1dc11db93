#pragma once

#include <kte/static_chain/static_chain.hpp>

#include <algorithm>
#include <array>
#include <string>

/// Joints of several coordinates, composed of joints with one coordinate and a frame between them.
namespace kte {

/// The key of the frame between the two joints of a series, named after the end: "wrist.inner" for "wrist". `what`,
/// `text` and `name` are the members of a key.
template <key_type End>
struct inner_key {
  static constexpr kind what = End::what;
  static constexpr auto text = [] {
    constexpr std::string_view suffix = ".inner";
    std::array<char, End::name.size() + suffix.size()> all{};
    std::copy(suffix.begin(), suffix.end(), std::copy(End::name.begin(), End::name.end(), all.begin()));
    return all;
  }();
  static constexpr std::string_view name{text.data(), text.size()};
};
/// The frame between the two joints of a series with the given end, such as a `universal_joint_3D`.
template <key_type End>
[[nodiscard]] constexpr inner_key<End> inner_of(const End&) {
  return {};
}
template <text_type End>
[[nodiscard]] std::string inner_of(const End& end) {
  return std::string(std::string_view(end)) + ".inner";
}

namespace detail {

template <class Name>
constexpr std::string_view text_of(const Name& name) {
  if constexpr (key_type<Name>) {
    return Name::name;
  } else if constexpr (text_type<Name>) {
    return name;
  } else {
    return {};  // rejected by `connect`
  }
}
template <class First, class Second>
class static_series;
/// Two elements in series: with keys a static chain; with texts a list that runtime chains append completely or not at
/// all.
template <class A, class B>
constexpr auto in_series(const A& first, const B& second) {
  if constexpr (is_element<A> && is_element<B>) {
    return static_series<A, B>(chain(first, second));
  } else if constexpr (std::is_same_v<A, refused> || std::is_same_v<B, refused>) {
    return refused{};
  } else {
    return together(first, second);
  }
}
template <class First, class Second>
class static_series : public static_chain<zero3, First, Second> {
 public:
  constexpr explicit static_series(const static_chain<zero3, First, Second>& c)
      : static_chain<zero3, First, Second>(c) {}

  /// The two joints, with the first placed at a position, m, and a rotation in the base.
  template <class... Place>
  constexpr auto at(const Place&... place) const {
    return in_series(boost::hana::at_c<0>(this->elements()).at(place...), boost::hana::at_c<1>(this->elements()));
  }
};
/// Checks both joints together.
template <class Check, class... Names>
constexpr void check_series(std::string_view type, const Check& check, const Names&... names) {
  constexpr std::array<port, 4> ports{{{kind::gen, access::in, "coordinate1"},
                                       {kind::gen, access::in, "coordinate2"},
                                       {kind::frame_3D, access::in, "base"},
                                       {kind::frame_3D, access::out, "end"}}};
  const std::array<std::string_view, 4> texts{text_of(names)...};
  parameter_check::breach broken;
  const parameter_check where{type, ports, texts, broken};
  check(where);
  require<bad_parameter>(!broken.rule, where, broken.rule, broken.value);
}

}  // namespace detail
}  // namespace kte
