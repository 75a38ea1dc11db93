#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/given_bases.hpp>
#include <kte/recursions/world_joints.hpp>

#include <utility>

/// The joints of a static chain in the world: every frame and joint is evaluated once, by type, then recursions loop
/// over numbers.
namespace kte::detail {

/// The joints of a chain, in order: the element of each, and the joint or base on which it is.
template <class Chain>
struct joints_of {
  static constexpr auto& steps = tree_steps<Chain>;
  static constexpr std::size_t count = [] {
    std::size_t n = 0;
    for (std::size_t e = 0; e < Chain::size; ++e) n += steps[e].axes > 0;
    return n;
  }();
  /// The joint that carries an element, or is the element; -1: a base.
  static constexpr auto joint_at = [] {
    std::array<int, Chain::size + 1> at{};
    int joints = 0;
    for (std::size_t e = 0; e < Chain::size; ++e) {
      const int below = steps[e].below;
      at[e] = steps[e].axes > 0 ? joints++ : below < 0 ? -1 : at[static_cast<std::size_t>(below)];
    }
    return at;
  }();
  static constexpr int joint_of(int e) { return e < 0 ? -1 : joint_at[static_cast<std::size_t>(e)]; }
  static constexpr auto element = [] {
    std::array<std::size_t, count + 1> e{};
    for (std::size_t i = Chain::size; i-- > 0;)
      if (steps[i].axes > 0) e[static_cast<std::size_t>(joint_at[i])] = i;
    return e;
  }();
};
/// The joints of a chain in the form of recursions/world_joints.hpp, with the motions of frames.
template <class S, class Chain, class Given>
class unrolled_joints {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  using joints = joints_of<Chain>;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  static constexpr auto& steps = tree_steps<Chain>;

 public:
  static constexpr int count() { return static_cast<int>(joints::count); }
  static constexpr int parent(int i) { return joints::joint_of(at(i).below); }
  static constexpr int first(int i) { return static_cast<int>(at(i).first); }
  static constexpr int axes(int i) { return at(i).axes; }
  KTE_INLINE const engine::joint_axis<S>& axis(int k) const { return axes_[static_cast<std::size_t>(k)]; }
  KTE_INLINE const vec3<S>& step(int i) const { return step_[static_cast<std::size_t>(i)]; }

  static constexpr std::size_t all_axes = steps[Chain::size].first;
  /// The row of each axis.
  static constexpr auto row = [] {
    std::array<int, all_axes + 1> rows{};
    for (const auto& s : steps)
      for (std::size_t n = 0; n < static_cast<std::size_t>(s.axes); ++n) rows[s.first + n] = s.row[n];
    return rows;
  }();

  KTE_INLINE unrolled_joints(const Chain& c, const Given& g) : motion_(c, g) {
    unroll<Chain::size>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template place<I>(); });
  }
  template <std::size_t I, std::size_t P>
  KTE_INLINE constexpr decltype(auto) at_port() const {
    return motion_.template get<types::template what<I, P>, wiring::slot(I, P)>();
  }
  /// From the end of the joint that carries the end of element I, to the latter, in axes of the world.
  template <int I>
  KTE_INLINE constexpr auto way_to() const {
    if constexpr (I < 0) {
      return zero3{};
    } else if constexpr (steps[std::size_t{I}].axes > 0) {
      return zero3{};
    } else {
      return way_over<I>();
    }
  }

 private:
  static constexpr const tree_step& at(int i) { return steps[joints::element[static_cast<std::size_t>(i)]]; }
  /// `way_to`, with the step of element I.
  template <int I>
  KTE_INLINE constexpr auto way_over() const {
    constexpr std::size_t e{I}, base = port_count<core_t<e>> - 2;
    if constexpr (is_transmission<core_t<e>>) {
      return way_to<steps[e].below>() + at_port<e, base>().rotation * motion_.template joint_pose<e>().position;
    } else {
      return zero3{};
    }
  }
  template <std::size_t I>
  KTE_INLINE void place() {
    if constexpr (!is_transmission<core_t<I>>) {
      static_assert(sizeof(pass_over<Chain, I>) > 0);
    } else if constexpr (steps[I].axes > 0) {
      step_[std::size_t{joints::joint_at[I]}] = as<S>(way_over<int{I}>());
      unroll<steps[I].axes>([&]<int N>() KTE_INLINE_LAMBDA {
        const auto s = motion_.template joint_axis<I, N>();
        const auto& r = at_port<I, port_count<core_t<I>> - 1>().rotation;
        axes_[steps[I].first + N] = {as<S>(r * s.velocity), as<S>(r * s.ang_velocity)};
      });
    }
  }

  const unrolled_motion<Chain, Given> motion_;
  // One more than needed, so that the arrays are not empty.
  std::array<vec3<S>, joints::count + 1> step_;
  std::array<engine::joint_axis<S>, all_axes + 1> axes_;
};

}  // namespace kte::detail
