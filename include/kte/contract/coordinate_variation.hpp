#pragma once

#include <kte/contract/joint.hpp>
#include <kte/math/dual.hpp>

/// Derivatives of the forces of elements on generalized coordinates, by dual numbers: springs, dampers, masses.
namespace kte::detail {

/// Whether an element connects to coordinates and signals only, and closes no loop.
template <class Core>
inline constexpr bool is_on_coordinates = [] {
  for (const auto& p : Core::ports)
    if (p.what == kind::loop || (p.what != kind::gen && !is_signal(p.what))) return false;
  return true;
}();

/// Whether the derivatives of the forces of an element are known: joints, links and bodies
/// (recursions/force_variations.hpp), and elements on coordinates.
template <class Core>
inline constexpr bool has_derivatives =
    is_transmission<Core> || is_on_coordinates<Core> || has_mass<Core, double> || Core::ports[0].how == access::base;

/// Derivatives by q, v, a of one coordinate.
template <class S>
using coordinate_dual = dual<S, 3>;

/// A coordinate as an argument of a kernel; if `on`, forces are derived by it.
template <class S, class C>
KTE_INLINE auto varied_coordinate(const C& c, bool on) {
  using number = coordinate_dual<S>;
  const S one(on ? 1 : 0);
  const auto variable = [&one](const auto& x, std::size_t i) KTE_INLINE_LAMBDA {
    number n(as<S>(x));
    n.derivative[i] = one;
    return n;
  };
  if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(c.cos)>, skip>) {
    number cosine(as<S>(c.cos)), sine(as<S>(c.sin));
    cosine.derivative[0] = -one * as<S>(c.sin), sine.derivative[0] = one * as<S>(c.cos);
    return coordinate{variable(c.q, 0), variable(c.q_dot, 1), variable(c.q_ddot, 2), cosine, sine};
  } else {
    return coordinate{variable(c.q, 0), variable(c.q_dot, 1), variable(c.q_ddot, 2), skip{}, skip{}};
  }
}

/// Subtracts the derivatives of a force from entries (i, j).
template <class S, class F, class Matrix>
KTE_INLINE void subtract_variation(const F& f, Matrix& by_q, Matrix& by_v, Matrix& by_a, int i, int j) {
  if constexpr (std::is_same_v<F, coordinate_dual<S>>) {  // otherwise independent of coordinates
    by_q(i, j) -= f.derivative[0];
    by_v(i, j) -= f.derivative[1];
    by_a(i, j) -= f.derivative[2];
  }
}

}  // namespace kte::detail
