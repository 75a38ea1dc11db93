#include "dynamics/varied_joints.hpp"

// The first variations of how motion and forces pass joints.

namespace variation_joints_test {

using namespace kte;
using namespace kte::detail;
using namespace kte::test::variations;

TEST_CASE("gyration_through is gyration seen from the base of an element") {
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

TEST_CASE("by_displacement and by_rate are derivatives of the motion of the end of a joint") {
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

TEST_CASE("a wrench that is displaced with its frame") {
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

TEST_CASE("sensitivity_along is the power of varied_wrench") {
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

TEST_CASE("sensitivity_through is the transpose of how motion passes an element") {
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

}  // namespace variation_joints_test
