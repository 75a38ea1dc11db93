#pragma once

#include <kte/chain/wiring.hpp>
#include <kte/frames/frame_2D.hpp>
#include <kte/frames/frame_3D.hpp>
#include <kte/frames/gen_coord.hpp>

#include <array>

namespace kte {

namespace detail {
/// Of four lists, that of kind K.
template <kind K, class C, class P, class S, class I>
constexpr auto& of_kind(C& coordinates, P& in_plane, S& in_space, I& inputs) {
  if constexpr (K == kind::gen) {
    return coordinates;
  } else if constexpr (K == kind::frame_2D) {
    return in_plane;
  } else if constexpr (K == kind::frame_3D) {
    return in_space;
  } else {
    return inputs;
  }
}
}  // namespace detail

/// The state of a static chain: every coordinate, frame and input by name, for the passes to work on and for users to
/// look at. A value; the chain itself never changes.
///
///   s[joint].position,  s[q].q_ddot,  s[motor] = 2.0
template <class Scalar, class Wiring>
class chain_state {
 public:
  using scalar = Scalar;
  using wiring = Wiring;
  static constexpr int dofs = Wiring::dofs;

  template <key_type Key>
  constexpr auto& operator[](const Key&) {
    return at(*this, Key{});
  }
  template <key_type Key>
  constexpr const auto& operator[](const Key&) const {
    return at(*this, Key{});
  }

  // By index, for the passes: coordinates 0 .. dofs-1 are the degrees of freedom.
  constexpr auto& coordinate(int i) { return coordinates_[static_cast<std::size_t>(i)]; }
  constexpr const auto& coordinate(int i) const { return coordinates_[static_cast<std::size_t>(i)]; }
  template <kind K>
  constexpr auto& get(int i) {
    return get<K>(*this, static_cast<std::size_t>(i));
  }
  template <kind K>
  constexpr const auto& get(int i) const {
    return get<K>(*this, static_cast<std::size_t>(i));
  }

 private:
  template <kind K, class Self>
  static constexpr auto& get(Self& s, std::size_t i) {
    return detail::of_kind<K>(s.coordinates_, s.frames_2D_, s.frames_3D_, s.inputs_)[i];
  }
  template <class Self, class Key>
  static constexpr auto& at(Self& s, Key) {
    constexpr int i = Wiring::template find<Key>();
    static_assert(i >= 0, "kte: this chain has nothing of this name");
    return get<Key::what>(s, static_cast<std::size_t>(i < 0 ? 0 : i));
  }
  static constexpr std::size_t count(kind k) { return static_cast<std::size_t>(Wiring::count(k)); }

  std::array<gen_coord<Scalar>, count(kind::gen)> coordinates_{};
  std::array<frame_2D<Scalar>, count(kind::frame_2D)> frames_2D_{};
  std::array<frame_3D<Scalar>, count(kind::frame_3D)> frames_3D_{};
  std::array<Scalar, count(kind::input)> inputs_{};
};

template <class T>
inline constexpr bool is_chain_state = false;
template <class Scalar, class Wiring>
inline constexpr bool is_chain_state<chain_state<Scalar, Wiring>> = true;

}  // namespace kte
