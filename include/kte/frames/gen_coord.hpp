#pragma once

#include <kte/math/sincos.hpp>

namespace kte {

/// A generalized coordinate of one degree of freedom, in the state of a chain.
///   q, q_dot, q_ddot   m or rad, and per second
///   f                  generalized force, N or Nm: with accelerations zero, q_ddot = M^-1 f
///   cos, sin           of q, set by doMotion where q turns a joint
template <class S = double>
struct gen_coord {
  S q{};
  S q_dot{};
  S q_ddot{};
  S f{};
  S cos = S(1);
  S sin{};
};

/// Computes cosine and sine of q.
template <class S>
KTE_INLINE constexpr void update_angle(gen_coord<S>& c) {
  sincos(c.q, c.sin, c.cos);
}

}  // namespace kte
