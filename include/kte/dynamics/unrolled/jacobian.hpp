#pragma once

#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/unrolled/columns.hpp>
#include <kte/recursions/jacobian.hpp>

/// Jacobians of frames of static chains, joint by joint.
namespace kte::detail {

/// The elements from a base to a frame.
template <class Chain, kind K, int Slot>
struct branch {
  static constexpr auto& steps = tree_steps<Chain>;
  static constexpr std::size_t length = [] {
    std::size_t n = 0;
    for (int e = Chain::wiring::writer(K, Slot); e >= 0; e = steps[std::size_t(e)].below) ++n;
    return n;
  }();
  static constexpr std::array<std::size_t, length + 1> elements = [] {
    std::array<std::size_t, length + 1> all{};
    int e = Chain::wiring::writer(K, Slot);
    for (std::size_t n = length; n-- > 0; e = steps[std::size_t(e)].below) all[n] = std::size_t(e);
    return all;
  }();
};

/// The columns of the joints of a branch: (1) of recursions/jacobian.hpp.
template <class S, class Chain, class Given>
class unrolled_jacobian : columns<S, Chain, Given> {
  using base = columns<S, Chain, Given>;

 public:
  using base::base;
  using typename base::matrix_type;

  /// In axes of the frame, which is at pose x in the end of element N - 1 of the branch, inward to the end of element
  /// End - 1, or the base.
  template <class Branch, std::size_t End = 0, std::size_t N = Branch::length, class X = pose<no_rotation, zero3>,
            class Sign = one_t>
  KTE_INLINE void inward(const X& x = {}, Sign sign = {}) {
    if constexpr (N > End) {
      constexpr std::size_t i = Branch::elements[N - 1];
      const auto rotation = transpose(x.rotation);
      base::template for_each_axis<i>([&]<int M>() KTE_INLINE_LAMBDA {
        const auto column = engine::jacobian_column_in_body(rotation, x.position, this->template axis<i, M>());
        this->template put<i, M>(sign * column.linear, sign * column.angular);
      });
      inward<Branch, End, N - 1>(compose(this->template pose_of_element<i>(), x), sign);
    }
  }
  /// In axes of the base, from the base to the frame; returns its position. x: pose of the end of element N - 1.
  template <class Branch, std::size_t N = 0, class X = pose<no_rotation, zero3>>
  KTE_INLINE auto outward(const X& x = {}) {
    if constexpr (N == Branch::length) {
      return x.position;
    } else {
      constexpr std::size_t i = Branch::elements[N];
      const auto end = compose(x, this->template pose_of_element<i>());
      const auto p = outward<Branch, N + 1>(end);
      base::template for_each_axis<i>([&]<int M>() KTE_INLINE_LAMBDA {
        const auto column = engine::jacobian_column(end.rotation, p - end.position, this->template axis<i, M>());
        this->template put<i, M>(column.linear, column.angular);
      });
      return p;
    }
  }
};

/// Whether all elements between a base and a frame are links and joints.
template <class Chain, kind K, int Slot>
inline constexpr bool moves_rigidly = [] {
  const static_connections<Chain> c;
  for (int e = Chain::wiring::writer(K, Slot); e >= 0; e = tree_steps<Chain>[std::size_t(e)].below)
    if (!c.rigid(std::size_t(e))) return false;
  return true;
}();
/// The Jacobian of a frame that follows others.
template <bool World, class S, class Frame, class Chain, class At>
auto jacobian_by_rates(const Chain& c, const At& at) {
  six_by_dofs<S, Chain::dofs> j;
  std::array<S, std::size_t{Chain::dofs}> rates{};
  constexpr same_base base{motion{zero3{}, no_rotation{}, zero3{}, zero3{}, skip{}, skip{}}};
  engine::put_velocities_at_unit_rates<S>(j, rates, [&] {
    return engine::velocities_of<S>(motion_at<Frame>(c, given{at, each<S, decltype(rates)>{rates}, same<skip>{}, base}),
                                    World);
  });
  return j;
}

/// The Jacobian of a frame moved by joints and links.
template <bool World, class S, class Frame, class Chain, class At>
KTE_INLINE auto jacobian_along(const Chain& c, const At& at) {
  const given g{at, same<skip>{}, same<skip>{}, base_with_pose};
  using pass = unrolled_jacobian<S, Chain, std::remove_const_t<decltype(g)>>;
  using path = branch<Chain, Frame::what, frame_slot<Frame, Chain>()>;
  typename pass::matrix_type j;
  if constexpr (World) {
    pass(c, g, j).template outward<path>();
  } else {
    pass(c, g, j).template inward<path>();
  }
  return j;
}

template <bool World, class Frame, class Chain, class Q>
KTE_INLINE auto jacobian_of(const Chain& c, const Q& q) {
  using S = value_of<Q>;
  const auto x = detail::checked_arguments<Chain>(q);
  if constexpr (!moves_rigidly<Chain, Frame::what, frame_slot<Frame, Chain>()>) {
    return jacobian_by_rates<World, S, Frame>(c, x.at);
  } else {
    return jacobian_along<World, S, Frame>(c, x.at);
  }
}

}  // namespace kte::detail
