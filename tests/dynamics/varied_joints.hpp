#pragma once

#include <kte/elements/free_joint.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/spherical_joint.hpp>

#include <type_traits>

#include "dynamics/variations.hpp"

/// All joints at random places, and the same displaced along a velocity or faster along it.
namespace kte::test::variations {

/// A coordinate of a kind, and the same displaced along its velocity n, or faster along it.
template <kind K>
struct place {
  vector p;
  unit_quaternion<big> r;
  big q, q_dot, q_ddot;
  vector v, w, a, al;
  explicit place(random_numbers& random)
      : p(random_vector(random)),
        r(random_rotation(random)),
        q(random(3)),
        q_dot(random(2)),
        q_ddot(random(5)),
        v(random_vector(random)),
        w(random_vector(random)),
        a(random_vector(random)),
        al(random_vector(random)) {}
  auto coordinate_of() const {
    if constexpr (K == kind::gen) {
      return coordinate{q, q_dot, q_ddot, big(cos(q)), big(sin(q))};
    } else if constexpr (K == kind::rotation_3D) {
      return motion{zero3{}, matrix(r), zero3{}, w, zero3{}, al};
    } else {
      return motion{p, matrix(r), v, w, a, al};
    }
  }
  place displaced(int n, const big& h) const {
    place x = *this;
    constexpr int linear = K == kind::pose_3D ? 3 : 0;
    if (K == kind::gen) {
      x.q += h;
    } else if (n < linear) {
      x.p = as<big>(p + r * as<big>(h * unit(n)));
    } else {
      x.r = r * to_quaternion(as<big>(h * unit(n - linear)));
    }
    return x;
  }
  place faster(int n, const big& h) const {
    place x = *this;
    constexpr int linear = K == kind::pose_3D ? 3 : 0;
    if (K == kind::gen) {
      x.q_dot += h;
    } else if (n < linear) {
      x.v = as<big>(v + h * unit(n));
    } else {
      x.w = as<big>(w + h * unit(n - linear));
    }
    return x;
  }
};

template <int N, class F>
void repeat(const F& f) {
  [&]<int... K>(std::integer_sequence<int, K...>) { (f(std::integral_constant<int, K>{}), ...); }
  (std::make_integer_sequence<int, N>{});
}
/// f of each joint there is, at random places in turn: f(joint, place).
template <class F>
void with_all_joints(unsigned seed, const F& f) {
  random_numbers random(seed);
  for (int round = 0; round < 4; ++round) {
    const auto n = random_axis(random);
    using frame = std::integral_constant<kind, kind::frame_3D>;
    f(core::revolute_joint<frame::value, vector>(n), place<kind::gen>(random), random);
    f(core::revolute_joint<frame::value, std::remove_const_t<decltype(axis::z)>>(axis::z), place<kind::gen>(random),
      random);
    f(core::prismatic_joint<frame::value, vector>(n), place<kind::gen>(random), random);
    f(core::prismatic_joint<frame::value, std::remove_const_t<decltype(axis::minus_x)>>(axis::minus_x),
      place<kind::gen>(random), random);
    f(core::screw_joint<vector, big>(n, random()), place<kind::gen>(random), random);
    f(core::spherical_joint{}, place<kind::rotation_3D>(random), random);
    f(core::free_joint<frame::value>{}, place<kind::pose_3D>(random), random);
  }
}

}  // namespace kte::test::variations
