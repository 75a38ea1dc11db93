#include <kte/elements/free_joint.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/kernels/variation.hpp>
#include <kte/math/rigid_motion.hpp>

#include <Eigen/Core>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <type_traits>

#include "catch.hpp"
#include "random.hpp"

// The first variations of inverse dynamics, one kernel at a time, against central differences at 50 digits of the
// functions that they differentiate: `compose`, `transmit`, and Newton's and Euler's equations.
//
// Steps of 1e-16 err by 1e-32 times a third derivative and lose 1e-50/1e-16 = 1e-34 times the function; numbers go up
// to 1e2. Measured 1.5e-32 where positions change. By rates all is of second degree, which leaves the loss alone:
// measured 2.7e-33. What has no differences in it is right to 1e-46; measured 3e-49.

using namespace kte;
using namespace kte::detail;
using big = boost::multiprecision::cpp_bin_float_50;
using vector = vec3<big>;
using square = mat3<vector>;

namespace {

constexpr double by_position_bound = 1e-30, by_rate_bound = 1e-32;
const big step("1e-16");

vector random_vector(random_numbers& random) { return {big(random(2)), big(random(2)), big(random(2))}; }
square random_matrix(random_numbers& random) {
  return {random_vector(random), random_vector(random), random_vector(random)};
}
auto random_rotation(random_numbers& random) { return to_quaternion(random_vector(random)); }
auto random_inertia(random_numbers& random) {
  const auto n = [&] { return big(random(2)); };
  return to_composite(rigid_body{n(), random_vector(random), sym3{n(), n(), n(), n(), n(), n()}});
}
auto random_motion(random_numbers& random) {
  return motion{random_vector(random), matrix(random_rotation(random)), random_vector(random),
                random_vector(random), random_vector(random),           random_vector(random)};
}
vector random_axis(random_numbers& random) {
  const auto v = random_vector(random);
  return as<big>(big(1 / sqrt(dot(v, v))) * v);
}
vector unit(int k) { return {big(k == 0), big(k == 1), big(k == 2)}; }

/// A change of motion, a wrench or a number as numbers.
template <class V>
Eigen::Matrix<big, 3, 1> column(const V& v) {
  return {as<big>(v.x), as<big>(v.y), as<big>(v.z)};
}
template <class W, class A, class AL>
Eigen::Matrix<big, 9, 1> numbers(const variation<W, A, AL>& d) {
  Eigen::Matrix<big, 9, 1> r;
  r << column(d.ang_velocity), column(d.acceleration), column(d.ang_acceleration);
  return r;
}
template <class F, class T>
Eigen::Matrix<big, 6, 1> numbers(const wrench<F, T>& w) {
  Eigen::Matrix<big, 6, 1> r;
  r << column(w.force), column(w.torque);
  return r;
}
template <class F, class T>
Eigen::Matrix<big, 6, 3> numbers(const gyration<F, T>& g) {
  Eigen::Matrix<big, 6, 3> r;
  const auto f = [&](int k) { return as<big>(g.force * unit(k)); };
  const auto t = [&](int k) { return as<big>(g.torque * unit(k)); };
  for (int k = 0; k < 3; ++k) r.col(k) << column(f(k)), column(t(k));
  return r;
}
/// Of a motion, what a `variation` is the change of.
template <class M>
auto rates_of(const M& m) {
  return numbers(variation{m.ang_velocity, m.acceleration, m.ang_acceleration});
}
auto variation_from(const Eigen::Matrix<big, 9, 1>& x) {
  const auto part = [&](int i) { return vector{x[i], x[i + 1], x[i + 2]}; };
  return variation{part(0), part(3), part(6)};
}
template <class M, class V>
auto moved(M m, const V& d, const big& h) {
  m.ang_velocity = as<big>(m.ang_velocity + h * d.ang_velocity);
  m.acceleration = as<big>(m.acceleration + h * d.acceleration);
  m.ang_acceleration = as<big>(m.ang_acceleration + h * d.ang_acceleration);
  return m;
}
/// (f(h) - f(-h)) / 2h
template <class F>
auto difference_of(const F& f) {
  return ((f(step) - f(-step)) / (2 * step)).eval();
}
template <class X, class Y>
double gap(const X& x, const Y& y) {
  big most = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    most = test::worse(most, big(abs(x.data()[i] - y.data()[i])));
  }
  return static_cast<double>(most);
}
struct worst_gap {
  double value = 0;
  template <class X, class Y>
  void operator()(const X& x, const Y& y) {
    value = test::worse(value, gap(x, y));
  }
  void below(double bound) const {
#ifdef KTE_PRINT
    std::printf("%.1e\n", value);
#endif
    CHECK(value < bound);
  }
};

/// Newton and Euler: what moves a body by these rates.
template <class C, class M>
auto wrench_of(const C& b, const M& m) {
  const auto& w = m.ang_velocity;
  return wrench{b.mass * m.acceleration + cross(m.ang_acceleration, b.moment) + cross(w, cross(w, b.moment)),
                b.inertia * m.ang_acceleration + cross(b.moment, m.acceleration) + cross(w, b.inertia * w)};
}

// ---- relative motions

/// A nut on a screw of pitch h a radian about an axis n, in no library: p = h q n.
template <class Axis>
struct screw : transmission<screw<Axis>> {
  static constexpr type_name type{"screw_joint", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  big pitch;
  Axis axis;
  screw(const big& m_per_rad, const Axis& direction) : pitch(m_per_rad), axis(direction) {}
  template <class C>
  auto relative(const C& x) const {
    const auto along = [this](const auto& rate) { return (pitch * rate) * axis; };
    return motion{along(x.q),     rotation_about(axis, x.cos, x.sin), along(x.q_dot), axis * x.q_dot, along(x.q_ddot),
                  axis * x.q_ddot};
  }
};

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
    f(screw<vector>(big(random()), n), place<kind::gen>(random), random);
    f(core::spherical_joint{}, place<kind::rotation_3D>(random), random);
    f(core::free_joint<frame::value>{}, place<kind::pose_3D>(random), random);
  }
}

}  // namespace

TEST_CASE("centripetal_by_rate and gyration_of are derivatives by the angular velocity", "[variation]") {
  random_numbers random(1);
  worst_gap worst;
  for (int round = 0; round < 10; ++round) {
    const auto b = random_inertia(random);
    const auto m = random_motion(random);
    const auto r = random_vector(random);
    const auto g = numbers(gyration_of(b, m.ang_velocity));
    const auto k = centripetal_by_rate(m.ang_velocity, r);
    for (int i = 0; i < 3; ++i) {
      const variation d{unit(i), zero3{}, zero3{}};
      worst(Eigen::Matrix<big, 6, 1>(g.col(i)),
            difference_of([&](const big& h) { return numbers(wrench_of(b, moved(m, d, h))); }));
      worst(column(as<big>(k * unit(i))), difference_of([&](const big& h) {
              const auto w = as<big>(m.ang_velocity + h * unit(i));
              return column(as<big>(cross(w, cross(w, r))));
            }));
    }
  }
  worst.below(by_rate_bound);
}

TEST_CASE("gyration and inertia add up, and none is none", "[variation]") {
  random_numbers random(2);
  const gyration a{random_matrix(random), random_matrix(random)}, b{random_matrix(random), random_matrix(random)};
  CHECK(gap(numbers(a + b), (numbers(a) + numbers(b)).eval()) == 0);
  STATIC_REQUIRE(std::is_same_v<decltype(a + no_gyration), std::remove_const_t<decltype(a)>>);
  CHECK(gap(numbers(a + no_gyration), numbers(a)) == 0);
  const auto i = random_inertia(random), j = random_inertia(random);
  const auto sum = turning_body{i, a} + turning_body{j, b};
  const auto m = random_motion(random);
  const variation d{m.ang_velocity, m.acceleration, m.ang_acceleration};
  CHECK(gap(numbers(varied_wrench(sum.inertia, sum.gyration, d)),
            (numbers(varied_wrench(i, a, d)) + numbers(varied_wrench(j, b, d))).eval()) < 1e-46);
}

TEST_CASE("varied_wrench is the wrench's derivative by all rates", "[variation]") {
  random_numbers random(3);
  worst_gap worst;
  for (int round = 0; round < 10; ++round) {
    const auto b = random_inertia(random);
    const auto m = random_motion(random);
    const variation d{random_vector(random), random_vector(random), random_vector(random)};
    worst(numbers(varied_wrench(b, gyration_of(b, m.ang_velocity), d)),
          difference_of([&](const big& h) { return numbers(wrench_of(b, moved(m, d, h))); }));
  }
  worst.below(by_rate_bound);
}

TEST_CASE("gyration_through is gyration seen from the base of an element", "[variation]") {
  // With any gyration at the end, not that of a body: the wrench at the base changes by what `transmit` makes of the
  // change at the end, whose motion is that of `compose`.
  worst_gap worst;
  with_all_joints(4, [&](const auto& joint, const auto& at, random_numbers& random) {
    const auto x = joint.relative(at.coordinate_of());
    const auto b = random_inertia(random);
    const gyration g{random_matrix(random), random_matrix(random)};
    const auto base = random_motion(random);
    const auto here = transported(x.rotation, x.position, b);
    const auto seen = gyration_through(x, base.ang_velocity, b, g);
    const variation d{random_vector(random), random_vector(random), random_vector(random)};
    const auto at_end =
        variation_from(difference_of([&](const big& h) { return rates_of(compose(moved(base, d, h), x)); }));
    worst(numbers(varied_wrench(here, seen, d)), numbers(transmit(x, varied_wrench(b, g, at_end))));
    for (int k = 0; k < 3; ++k) {
      const variation turn{unit(k), zero3{}, zero3{}};
      const auto end =
          variation_from(difference_of([&](const big& h) { return rates_of(compose(moved(base, turn, h), x)); }));
      worst(Eigen::Matrix<big, 6, 1>(numbers(seen).col(k)), numbers(transmit(x, varied_wrench(b, g, end))));
    }
  });
  worst.below(by_rate_bound);
}

TEST_CASE("gyration_through of a body is its gyration as part of the base", "[variation]") {
  // Fixed to the base by a link, a body turns with it: gyration_of what it is there.
  random_numbers random(5);
  worst_gap worst;
  for (int round = 0; round < 10; ++round) {
    const auto b = random_inertia(random);
    const auto w = random_vector(random);
    const auto x = at_rest(matrix(random_rotation(random)), random_vector(random));
    const auto w_end = as<big>(transpose(x.rotation) * w);
    worst(numbers(gyration_through(x, w, b, gyration_of(b, w_end))),
          numbers(gyration_of(transported(x.rotation, x.position, b), w)));
  }
  worst.below(1e-46);
}

TEST_CASE("by_displacement and by_rate are derivatives of the motion of the end of a joint", "[variation]") {
  worst_gap by_position, by_velocity;
  with_all_joints(6, [&](const auto& joint, const auto& at, random_numbers& random) {
    const auto base = random_motion(random);
    const auto c = at.coordinate_of();
    const auto x = joint.relative(c);
    using core = std::remove_cvref_t<decltype(joint)>;
    repeat<joint_dofs<core>>([&](auto n) {
      const auto s = axis_of<n()>(joint, c);
      by_position(numbers(by_displacement(x, s, base)), difference_of([&](const big& h) {
                    return rates_of(compose(base, joint.relative(at.displaced(n(), h).coordinate_of())));
                  }));
      by_velocity(numbers(by_rate(x, s, base)), difference_of([&](const big& h) {
                    return rates_of(compose(base, joint.relative(at.faster(n(), h).coordinate_of())));
                  }));
    });
  });
  by_position.below(by_position_bound);
  by_velocity.below(by_rate_bound);
}

TEST_CASE("a wrench that is displaced with its frame", "[variation]") {
  worst_gap worst;
  with_all_joints(7, [&](const auto& joint, const auto& at, random_numbers& random) {
    const auto c = at.coordinate_of();
    const auto x = joint.relative(c);
    const wrench w{random_vector(random), random_vector(random)};
    using core = std::remove_cvref_t<decltype(joint)>;
    repeat<joint_dofs<core>>([&](auto n) {
      const auto s = axis_of<n()>(joint, c);
      const vector v = as<big>(s.velocity), turn = as<big>(s.ang_velocity);
      worst(numbers(by_displacement(s, w)), difference_of([&](const big& h) {
              const auto there = exponential(as<big>(h * v), as<big>(h * turn));
              return numbers(transmit(pose{matrix(there.rotation), there.position}, w));
            }));
      // The base feels it where the end was.
      worst(numbers(transmit(x, by_displacement(s, w))), difference_of([&](const big& h) {
              return numbers(transmit(joint.relative(at.displaced(n(), h).coordinate_of()), w));
            }));
    });
  });
  worst.below(by_position_bound);
}

TEST_CASE("sensitivity_along is the power of varied_wrench", "[variation]") {
  worst_gap worst;
  with_all_joints(8, [&](const auto& joint, const auto& at, random_numbers& random) {
    const auto b = random_inertia(random);
    const gyration g{random_matrix(random), random_matrix(random)};
    using core = std::remove_cvref_t<decltype(joint)>;
    repeat<joint_dofs<core>>([&](auto n) {
      const auto s = axis_of<n()>(joint, at.coordinate_of());
      const variation d{random_vector(random), random_vector(random), random_vector(random)};
      const big x = change(sensitivity_along(b, g, s), d), y = power(s, varied_wrench(b, g, d));
      worst(Eigen::Matrix<big, 1, 1>(x), Eigen::Matrix<big, 1, 1>(y));
    });
  });
  worst.below(1e-46);
}

TEST_CASE("sensitivity_through is the transpose of how motion passes an element", "[variation]") {
  worst_gap worst, dense;
  with_all_joints(9, [&](const auto& joint, const auto& at, random_numbers& random) {
    const auto x = joint.relative(at.coordinate_of());
    const auto base = random_motion(random);
    const sensitivity z{wrench{random_vector(random), random_vector(random)}, random_vector(random)};
    const auto y = sensitivity_through(x, base.ang_velocity, z);
    // The matrix of (2) and (3), column by column; z^T times it.
    Eigen::Matrix<big, 9, 9> passes;
    for (int k = 0; k < 9; ++k) {
      const auto d = variation_from(Eigen::Matrix<big, 9, 1>(Eigen::Matrix<big, 9, 1>::Unit(k)));
      passes.col(k) = difference_of([&](const big& h) { return rates_of(compose(moved(base, d, h), x)); });
      const auto at_end = variation_from(passes.col(k));
      worst(Eigen::Matrix<big, 1, 1>(big(change(y, d))), Eigen::Matrix<big, 1, 1>(big(change(z, at_end))));
    }
    Eigen::Matrix<big, 9, 1> at_end, at_base;
    at_end << column(z.to_rate), column(z.to_acceleration.force), column(z.to_acceleration.torque);
    at_base << column(y.to_rate), column(y.to_acceleration.force), column(y.to_acceleration.torque);
    dense(at_base, (passes.transpose() * at_end).eval());
  });
  worst.below(by_rate_bound);
  dense.below(by_rate_bound);
}
