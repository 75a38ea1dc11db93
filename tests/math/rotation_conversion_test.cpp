#include <kte/math/axis.hpp>

#include <Eigen/Geometry>

#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "digits50.hpp"
#include "math/draw.hpp"
#include "math/gap.hpp"

namespace rotation_conversion_test {

using namespace kte;
using test::eigen;
using test::gap;

/// Largest errors of the round trips, by what is compared.
template <class S>
struct errors {
  S quaternion{}, matrix{}, vector{}, axis_angle{};
};
/// All pairs of conversions of one rotation.
template <class S>
void round_trips(const unit_quaternion<S>& q, errors<S>& e) {
  const auto worst = [](S& x, const S& y) { x = y <= x ? x : y; };
  const auto m = matrix(q);
  const auto r = to_rotation_vector(q);
  const auto a = to_axis_angle(q);
  worst(e.quaternion, gap(to_quaternion(m), q));
  worst(e.quaternion, gap(to_quaternion(r), q));
  worst(e.quaternion, gap(to_quaternion(a), q));
  worst(e.matrix, gap(matrix(to_quaternion(m)), m));
  worst(e.matrix, gap(matrix(to_rotation_vector(m)), m));
  worst(e.matrix, gap(matrix(to_axis_angle(m)), m));
  worst(e.vector, gap(to_rotation_vector(to_quaternion(r)), r));
  worst(e.vector, gap(to_rotation_vector(matrix(r)), r));
  worst(e.vector, gap(to_rotation_vector(to_axis_angle(r)), r));
  worst(e.axis_angle, gap(to_axis_angle(to_quaternion(a)), a));
  worst(e.axis_angle, gap(to_axis_angle(matrix(a)), a));
  worst(e.axis_angle, gap(to_axis_angle(to_rotation_vector(a)), a));
}
template <class S>
void check_round_trips(int n, const S& eps) {
  // In eps, two roundings of a number near 1. normalized leaves the length of q off by 1.5; matrix() doubles that and
  // adds three roundings of numbers up to 2: 6. Back, two entries are added, divided by 4 w >= 2, and brought to
  // length 1: 4. Angles magnify this by up to pi/2 and add the roundings of atan2, a root and a product: 8. A matrix by
  // way of an angle has twice the error of its quaternion, and its own: 12. The largest seen: 3.2, 9, 6, 6.
  test::draw draw(31);
  errors<S> e;
  for (int i = 0; i < n; ++i) {
    const auto q = draw.rotation();
    round_trips(detail::canonical(normalized(S(q.w), S(q.x), S(q.y), S(q.z))), e);
  }
  CHECK(e.quaternion <= S(4) * eps);
  CHECK(e.matrix <= S(12) * eps);
  CHECK(e.vector <= S(8) * eps);
  CHECK(e.axis_angle <= S(8) * eps);
}

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;

/// Coordinate axes, diagonals of planes and of space of all signs, and axes close to these.
std::vector<vec3<>> axes() {
  std::vector<vec3<>> r;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        for (const double s : {1.0, 1e-3, 1e-9}) {
          if (x == 0 && y == 0 && z == 0) continue;
          const auto q = normalized(0.0, 1.0 * x, s * y, s * s * z + (x == 0 && y == 0 ? z : 0));
          if (x != 0 || s == 1.0) r.push_back({q.x, q.y, q.z});
        }
  r.push_back({0.6, 0.0, -0.8});
  return r;
}

/// Half the angle between two rotations, whatever their signs.
double apart(const unit_quaternion<>& a, const unit_quaternion<>& b) {
  const auto d = as<long double>(conjugate(as<long double>(a)) * as<long double>(b));
  return static_cast<double>(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z));
}

TEST_CASE("conversions of random rotations are mutually inverse") {
  check_round_trips<double>(100000, std::numeric_limits<double>::epsilon());
  check_round_trips<float>(100000, std::numeric_limits<float>::epsilon());
  check_round_trips<long double>(20000, std::numeric_limits<long double>::epsilon());
}

TEST_CASE("conversions keep fifty digits", "[long]") {
  check_round_trips<kte::test::digits50>(1000, kte::test::digits50(1e-48) / 12);
  using std::sqrt;
  const kte::test::digits50 pi50 = 4 * atan(kte::test::digits50(1));
  const vec3<kte::test::digits50> n{kte::test::digits50(2) / 7, kte::test::digits50(-3) / 7,
                                    kte::test::digits50(6) / 7};
  for (const kte::test::digits50& t :
       {kte::test::digits50("1e-300"), kte::test::digits50("1e-40"), kte::test::digits50("1e-8"),
        kte::test::digits50(1), kte::test::digits50(pi50 / 2)}) {
    const axis_angle<kte::test::digits50> a{t, n};
    const auto r = t * n;
    CHECK(gap(to_rotation_vector(matrix(a)), r) <= kte::test::digits50("1e-48") * t);
    CHECK(gap(to_rotation_vector(matrix(r)), r) <= kte::test::digits50("1e-48") * t);
    CHECK(gap(to_axis_angle(to_quaternion(r)).axis, n) <= kte::test::digits50("1e-48"));
    CHECK(test::size(kte::test::digits50(to_axis_angle(r).angle - t)) <= kte::test::digits50("1e-48") * t);
  }
  CHECK(gap(matrix(axis_angle<kte::test::digits50>{pi50, n}), matrix(axis_angle<kte::test::digits50>{pi50, -n})) <=
        kte::test::digits50("1e-48"));
}

TEST_CASE("conversions agree with Eigen and with Rodrigues") {
  // Other formulas for these quantities: tolerances as for the round trips.
  test::draw draw(32);
  for (int i = 0; i < 10000; ++i) {
    const auto q = draw.rotation();  // w < 0 for every second one
    const Eigen::Quaterniond e(q.w, q.x, q.y, q.z);
    REQUIRE((eigen(matrix(q)) - e.toRotationMatrix()).cwiseAbs().maxCoeff() <= 6 * eps);
    const auto a = to_axis_angle(q);
    const Eigen::AngleAxisd ea(e);
    REQUIRE(std::abs(a.angle - ea.angle()) <= 8 * eps);
    REQUIRE((eigen(a.axis) - ea.axis()).cwiseAbs().maxCoeff() * std::min(1.0, a.angle) <= 8 * eps);
    REQUIRE(gap(to_rotation_vector(q), a.angle * a.axis) <= 8 * eps);
    const auto r = rotation_about(a.axis, std::cos(a.angle), std::sin(a.angle));
    REQUIRE(gap(r, matrix(a)) <= 12 * eps);
    REQUIRE(gap(r, rotation_about(a.axis, a.angle)) == 0);
  }
}

TEST_CASE("small rotations keep their digits relative to their angle") {
  // Everything but a rounding or two in each of four steps is exact, and nothing is added to larger numbers.
  for (const auto& n : axes()) {
    for (const double t : {1e-300, 1e-160, 1e-155, 1e-100, 1e-17, 1e-9, 2e-8, 1e-8, 1e-4}) {
      CAPTURE(n.x, n.y, n.z, t);
      const axis_angle<> a{t, n};
      const auto r = t * n;
      CHECK(gap(to_rotation_vector(a), r) <= 4 * eps * t);
      CHECK(gap(to_rotation_vector(to_quaternion(r)), r) <= 4 * eps * t);
      CHECK(gap(to_rotation_vector(matrix(r)), r) <= 4 * eps * t);
      CHECK(gap(to_rotation_vector(matrix(a)), r) <= 4 * eps * t);
      CHECK(std::abs(to_axis_angle(r).angle - t) <= 4 * eps * t);
      CHECK(std::abs(to_axis_angle(matrix(a)).angle - t) <= 4 * eps * t);
      CHECK(gap(to_axis_angle(r).axis, n) <= 4 * eps);
      CHECK(gap(to_axis_angle(matrix(r)).axis, n) <= 4 * eps);
      CHECK(to_quaternion(r).w == within_relative(1, 1e-8));
    }
  }
}

TEST_CASE("rotations up to half a turn") {
  // Near pi the sign of the axis hangs on the last digits of w, so rotations are compared, not vectors: within 4 eps of
  // half the angle, or 3 eps more for a matrix. w itself is known to an eps, and so is the angle, to 8 eps.
  for (const auto& n : axes()) {
    for (int k = 0; k <= 17; ++k) {
      const double t = k == 0 ? pi / 2 : k == 17 ? pi : pi - std::pow(10.0, -k);
      CAPTURE(n.x, n.y, n.z, k);
      const axis_angle<> a{t, n};
      const auto q = to_quaternion(a);
      const auto m = matrix(a);
      CHECK(q.w >= 0);
      CHECK(apart(q, {std::cos(t / 2), std::sin(t / 2) * n.x, std::sin(t / 2) * n.y, std::sin(t / 2) * n.z}) <= eps);
      CHECK(gap(rotation_about(n, t), m) <= 6 * eps);
      CHECK(apart(to_quaternion(t * n), q) <= 4 * eps);
      CHECK(apart(to_quaternion(m), q) <= 7 * eps);
      CHECK(apart(to_quaternion(to_rotation_vector(q)), q) <= 4 * eps);
      CHECK(apart(to_quaternion(to_rotation_vector(m)), q) <= 7 * eps);
      CHECK(apart(to_quaternion(to_axis_angle(t * n)), q) <= 4 * eps);
      for (const auto& b : {to_axis_angle(m), to_axis_angle(q), to_axis_angle(t * n)}) {
        CHECK(std::abs(b.angle - t) <= 8 * eps);
        CHECK(b.angle <= pi);
        CHECK(std::abs(dot(b.axis, b.axis) - 1) <= 4 * eps);
      }
    }
  }
}

TEST_CASE("rotations beyond half a turn come back within it") {
  const axis_angle<> a{4.0, {0.6, 0.0, -0.8}}, same{2 * pi - 4.0, {-0.6, 0.0, 0.8}};
  CHECK(gap(to_axis_angle(to_quaternion(a)), same) <= 8 * eps);
  CHECK(gap(to_axis_angle(a.angle * a.axis), same) <= 8 * eps);
  CHECK(gap(to_rotation_vector(axis_angle<>{-0.5, axis_angle<>{}.axis}), {-0.5, 0.0, 0.0}) <= eps);
}

}  // namespace rotation_conversion_test
