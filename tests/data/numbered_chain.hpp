#pragma once

#include <kte/kte.hpp>

#include <string>
#include <utility>

#include "data/serial_chain.hpp"

/// Serial chains of any length, static and runtime, from a table of bodies. Frame "base"; then coordinate "q1", frames
/// "mount1" and "link1", "q2" and so on. The elements of a body: a rigid link, a revolute joint, an inertia.
namespace kte::reference {

/// A text and a number: numbered<"q", 12>() is "q12".
template <fixed_string Text, int I>
constexpr auto numbered() {
  static_assert(I >= 0);
  constexpr std::size_t digits = [] {
    std::size_t n = 1;
    for (int i = I; i > 9; i /= 10) ++n;
    return n;
  }();
  constexpr std::size_t length = Text.view().size();
  char text[length + digits + 1]{};
  std::copy_n(Text.text, length, text);
  for (std::size_t k = digits, i = I; k-- > 0; i /= 10) text[length + k] = static_cast<char>('0' + i % 10);
  return fixed_string(text);
}

namespace numbered_names {
inline constexpr struct base_ final : frame_3D_key<"base"> {
} base;
template <int I>
struct q_ final : coord_key<numbered<"q", I>()> {};
template <int I>
struct mount_ final : frame_3D_key<numbered<"mount", I>()> {};
template <int I>
struct link_ final : frame_3D_key<numbered<"link", I>()> {};
/// The names of body I, which counts from 1; link<0> is the base.
template <int I>
inline constexpr q_<I> q{};
template <int I>
inline constexpr mount_<I> mount{};
template <int I>
inline constexpr link_<I> link{};
template <>
inline constexpr base_ link<0>{};
}  // namespace numbered_names

namespace detail {
/// Element K of the chain.
template <std::size_t K, std::size_t N>
constexpr auto numbered_element(const serial_body (&bodies)[N]) {
  using namespace numbered_names;
  constexpr int i = static_cast<int>(K / 3) + 1;
  const serial_body& b = bodies[K / 3];
  if constexpr (K % 3 == 0) {
    return rigid_link_3D(link<i - 1>, mount<i>, b.position, b.rotation);
  } else if constexpr (K % 3 == 1) {
    return revolute_joint_3D(q<i>, mount<i>, link<i>, b.axis);
  } else {
    return inertia_3D(link<i>, b.body);
  }
}
}  // namespace detail

/// The static chain, under gravity (0, 0, -9.81). Every number is a parameter: nothing is typed.
template <std::size_t N>
constexpr auto static_chain_of(const serial_body (&bodies)[N]) {
  return [&]<std::size_t... K>(std::index_sequence<K...>) {
    return chain(detail::numbered_element<K>(bodies)...).gravity(along_z(-9.81));
  }
  (std::make_index_sequence<3 * N>{});
}

/// The runtime chain.
template <std::size_t N>
runtime_chain runtime_chain_of(const serial_body (&bodies)[N]) {
  runtime_chain c;
  c.gravity(along_z(-9.81));
  std::string before = "base";
  for (std::size_t i = 0; i < N; ++i) {
    const auto number = std::to_string(i + 1);
    const auto& b = bodies[i];
    c << rigid_link_3D(before, "mount" + number, b.position, b.rotation)
      << revolute_joint_3D("q" + number, "mount" + number, "link" + number, b.axis)
      << inertia_3D("link" + number, b.body);
    before = "link" + number;
  }
  return c;
}

}  // namespace kte::reference
