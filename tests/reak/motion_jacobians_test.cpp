#include <kte/dynamics/relative_motion.hpp>
#include <kte/reak/motion_jacobians.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"

// Motion Jacobians: of chains against `jacobian` and its rate, in other frames against those of these frames.

namespace motion_jacobians_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double rounding = 200 * std::numeric_limits<double>::epsilon();  // as of rates of Jacobians

/// Rows of six that a frame has.
template <class J>
auto rows_of(const J& six, kind k) {
  Eigen::MatrixXd r = six;
  if (k == kind::frame_3D) return r;
  Eigen::MatrixXd planar(3, six.cols());
  planar << r.row(0), r.row(1), r.row(5);
  return planar;
}

/// Columns from `first` on; then at another frame of the same body or beyond.
template <class Chain, class Coordinate, class Frame, class Other>
void check(const Chain& c, const Coordinate& by, int first, const Frame& frame, const Other& other, unsigned seed) {
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion_of<double, Chain> m(c, random);
    const auto j = motion_jacobian_of(c, m.q, m.v, by, frame);
    using type = std::remove_const_t<decltype(j)>;
    CHECK(gap(j.matrix(), rows_of(jacobian(c, m.q, frame), Frame::what).middleCols(first, type::columns)) == 0);
    CHECK(gap(j.rate(), rows_of(jacobian_rate(c, m.q, m.v, frame), Frame::what).middleCols(first, type::columns)) == 0);
    const auto r = motion_jacobian_of<type>(model, s, m.q, m.v, by.name, frame.name);
    CHECK(gap(r.matrix(), j.matrix()) < rounding);
    CHECK(gap(r.rate(), j.rate()) < rounding);
    CHECK(gap(motion_jacobian_of<type>(model, s, by.name, frame.name).rate(), r.rate()) == 0);
    // Where the joint does not move `other` in `frame`, its Jacobian there is this one, seen from there.
    const auto there = motion_jacobian_of(c, m.q, m.v, by, other);
    CHECK(relative_jacobian(c, m.q, other, frame).middleCols(first, type::columns).isZero(0));
    const auto seen = [&] {
      const auto x = relative_motion(c, m.q, m.v, m.a, other, frame);
      if constexpr (Frame::what == kind::frame_3D) {
        return j.at(x);
      } else {
        return j.at(motion{vec3{x.position.x, x.position.y, zero}, rotation_2D{x.rotation.x.x, x.rotation.y.x},
                           vec3{x.velocity.x, x.velocity.y, zero}, vec3{zero, zero, x.ang_velocity.z}, skip{}, skip{}});
      }
    }();
    CHECK(gap(seen.matrix(), there.matrix()) < rounding);
    CHECK(gap(seen.rate(), there.rate()) < rounding);
  }
}

TEST_CASE("motion Jacobians of chains, and in other frames") {
  check(floating, trunk, 0, body, tip, 1);   // 3D_3D
  check(floating, ball, 6, hand, tip, 2);    // of a rotation
  check(floating, q2, 10, aside, aside, 3);  // gen_3D
  check(planar, puck, 0, cart, disc, 4);     // 2D_2D
  check(planar, q1, 3, disc, disc, 5);       // gen_2D
}

TEST_CASE("motion Jacobians of coordinates that follow others") {
  const auto model = models::element_by_element(geared);
  auto s = model.make_state();
  const std::array q{0.3, 0.4}, v{1.0, 2.0};
  const jacobian_gen_gen<> j = motion_jacobian_of(geared, q, v, q1, f2);
  CHECK(j.matrix()(0, 0) == -2.5);
  CHECK(j.rate()(0, 0) == 0);
  CHECK(motion_jacobian_of<jacobian_gen_gen<>>(model, s, q, v, "q1", "f2").matrix()(0, 0) == -2.5);
  CHECK(motion_jacobian_of(geared, q, v, q2, f2).matrix()(0, 0) == 0);
  CHECK(motion_jacobian_of<jacobian_gen_gen<>>(model, s, q, v, "q2", "q2").matrix()(0, 0) == 1);
  // Nothing follows a pose.
  const jacobian_2D_gen<> none =
      motion_jacobian_of(planar, std::array{0.1, 0.2, 0.3, 0.4}, std::array{1.0, 2.0, 3.0, 4.0}, puck, q1);
  CHECK(none.matrix().isZero(0));
}

TEST_CASE("motion Jacobians as matrices: rows and columns, value and rate") {
  jacobian_2D_3D<> j;
  for (std::size_t k = 0; k < 3; ++k) {
    const double n = 10 * double(k);
    j.column[k] = {{n + 1, n + 2, n + 3}, {n + 4, n + 5, n + 6}, {-n - 1, -n - 2, -n - 3}, {-n - 4, -n - 5, -n - 6}};
  }
  for (int row = 0; row < 6; ++row)
    for (int k = 0; k < 3; ++k) {
      CHECK(j.matrix()(row, k) == 10 * k + row + 1);
      CHECK(j.rate()(row, k) == -(10 * k + row + 1));
    }
  static_assert(jacobian_3D_2D<>::rows == 3 && jacobian_3D_2D<>::columns == 6);
  static_assert(jacobian_3D_gen<>::rows == 1 && jacobian_gen_3D<>::columns == 1);
  // A slide along x seen from a frame that turns about z, 1 m away: u x w_X as by the formula.
  jacobian_gen_3D<> slide;
  slide.column[0].velocity = {1, 0, 0};
  const auto seen = slide.at(motion{vec3{0.0, 1.0, 0.0}, no_rotation{}, zero3{}, vec3{0.0, 0.0, 2.0}, skip{}, skip{}});
  CHECK(seen.column[0].velocity == vec3{1.0, 0.0, 0.0});
  CHECK(seen.column[0].velocity_rate == vec3{0.0, -2.0, 0.0});
}

TEST_CASE("motion Jacobians of names of another kind") {
  const auto model = models::element_by_element(geared);
  auto s = model.make_state();
  const std::array q{0.3, 0.4}, v{1.0, 2.0};
  CHECK_THROWS_AS(motion_jacobian_of<jacobian_gen_3D<>>(model, s, q, v, "q3", "tip"), unknown_name);
  CHECK_THROWS_AS(motion_jacobian_of<jacobian_gen_3D<>>(model, s, q, v, "q1", "top"), unknown_name);
  CHECK_THROWS_AS(motion_jacobian_of<jacobian_gen_2D<>>(model, s, q, v, "q1", "tip"), unknown_name);
  CHECK_THROWS_AS(motion_jacobian_of<jacobian_3D_3D<>>(model, s, q, v, "q1", "tip"), unknown_name);
  CHECK_THROWS_MATCHES(motion_jacobian_of<jacobian_gen_3D<>>(model, s, q, v, "f1", "tip"), bad_argument,
                       says("'f1' is not a degree of freedom"));
}

}  // namespace motion_jacobians_test
