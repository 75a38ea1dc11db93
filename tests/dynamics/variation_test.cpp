#include "dynamics/variations.hpp"

// The first variations of what moves bodies.

namespace variation_test {

using namespace kte;
using namespace kte::detail;
using namespace kte::test::variations;

TEST_CASE("centripetal_by_rate and gyration_of are derivatives by the angular velocity") {
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

TEST_CASE("gyration and inertia add up") {
  random_numbers random(2);
  const gyration a{random_matrix(random), random_matrix(random)}, b{random_matrix(random), random_matrix(random)};
  CHECK(gap(numbers(a + b), (numbers(a) + numbers(b)).eval()) == 0);
  const auto i = random_inertia(random), j = random_inertia(random);
  const auto sum = turning_body{i, a} + turning_body{j, b};
  const auto m = random_motion(random);
  const variation d{m.ang_velocity, m.acceleration, m.ang_acceleration};
  CHECK(gap(numbers(varied_wrench(sum.inertia, sum.gyration, d)),
            (numbers(varied_wrench(i, a, d)) + numbers(varied_wrench(j, b, d))).eval()) < 1e-46);
}

TEST_CASE("varied_wrench is the wrench's derivative by all rates") {
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

TEST_CASE("gyration_through of a body is its gyration as part of the base") {
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

}  // namespace variation_test
