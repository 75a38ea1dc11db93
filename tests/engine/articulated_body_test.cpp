#include <kte/recursions/articulated_body.hpp>

#include <array>
#include <cmath>

#include "catch.hpp"

// Joints of several unit axes: eliminated axis by axis, with axes that are types, and on a matrix, by number.

namespace articulated_body_test {

using namespace kte;
using namespace kte::engine;

/// What both bodies have and the elimination does not ask for.
struct still_body {
  using scalar = double;
  static constexpr bool always_free = true;
  static constexpr bool free() { return true; }
  static constexpr int first() { return 0; }
  static vec3<double> in(const vec3<double>& u) { return u; }
  static vec3<double> out(const vec3<double>& u) { return u; }
  static zero3 position() { return {}; }
  static rigid_body<double, zero3, sym3<zero_t>> inertia() { return {1.0, {}, {}}; }
  static auto composite() { return to_composite(inertia()); }
};
template <int... N>
struct by_type : still_body {
  static constexpr int axes = sizeof...(N);
  template <int K>
  static constexpr auto axis() {
    constexpr int numbers[]{N...}, n = numbers[K];
    return motion_vector<vec3<constant<n == 0>, constant<n == 1>, constant<n == 2>>,
                         vec3<constant<n == 3>, constant<n == 4>, constant<n == 5>>>{};
  }
  template <int>
  static constexpr zero_t mass() {
    return {};
  }
};
template <int... N>
struct by_number : still_body {
  static constexpr int axis_count() { return sizeof...(N); }
  static constexpr int axis_number(int k) { return std::array{N...}[static_cast<std::size_t>(k)]; }
};

using numbers = std::array<double, 6>;
using inertia = articulated<sym3<double>, mat3<vec3<double>>, sym3<double>>;
using carried = articulated_body<inertia, wrench<vec3<double>, vec3<double>>>;
numbers numbers_of(const wrench<vec3<double>, vec3<double>>& w) {
  return {w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z};
}
/// What accelerations of one need, column by column, and the bias.
std::array<numbers, 7> numbers_of(const carried& x) {
  std::array<numbers, 7> all{};
  for (std::size_t k = 0; k < 6; ++k) {
    numbers e{};
    e[k] = 1;
    all[k] = numbers_of(accelerating_wrench(x.inertia, vec3{e[0], e[1], e[2]}, vec3{e[3], e[4], e[5]}));
  }
  all[6] = numbers_of(x.bias);
  return all;
}
// Entries are about 10, and each is a sum of some ten products: 20 roundings.
constexpr double rounding = 20 * 10 * 2.2e-16;
void check_same(const numbers& a, const numbers& b) {
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(a[i] - b[i]) <= rounding);
}

template <int... N>
void check_axes() {
  const rigid_body body{2.0, vec3{0.25, -0.5, 0.375}, sym3{1.5, 0.125, -0.25, 1.25, 0.0625, 1.0}};
  const rigid_body beyond{1.0, vec3{-0.5, 0.25, 1.0}, sym3{0.5, -0.125, 0.0, 0.75, 0.125, 0.5}};
  carried x{};
  assign(x, articulated_body{to_articulated(to_composite(body) + to_composite(beyond)),
                             wrench{vec3{1.0, -2.0, 0.5}, vec3{0.25, 3.0, -1.5}}});
  const auto force = [](int k) { return 0.5 + k; };
  std::array<axis_factors<double>, 6> typed{}, counted{}, last{};
  int bad = -1;
  const by_type<N...> a;
  const by_number<N...> b;
  carried left{};
  assign(left, after_elimination<0>(a, eliminated(a, x, force, typed.data(), bad), no_wrench, force(0)));
  const carried left_by_number = eliminated_by_number(b, x, force, counted.data(), false, bad);
  (void)eliminated_by_number(b, x, force, last.data(), true, bad);
  CHECK(bad == -1);
  const auto expected = numbers_of(left), found = numbers_of(left_by_number);
  for (std::size_t k = 0; k < 7; ++k) check_same(expected[k], found[k]);
  for (std::size_t k = 0; k < sizeof...(N); ++k)
    for (const auto* other : {&counted[k], &last[k]}) {
      CHECK(std::abs(typed[k].rate - other->rate) <= rounding);
      CHECK(std::abs(typed[k].inverse - other->inverse) <= rounding);
    }
  const auto axis = [](std::size_t k) { return std::array{N...}[k]; };
  for (std::size_t k = 0; k < sizeof...(N); ++k) {
    // Along an axis nothing is left but the force on it.
    for (std::size_t c = 0; c < 6; ++c) CHECK(expected[c][static_cast<std::size_t>(axis(k))] == 0);
    CHECK(expected[6][static_cast<std::size_t>(axis(k))] == force(static_cast<int>(k)));
  }

  motion_vector<vec3<double>, vec3<double>> given{{0.5, 1.0, -0.25}, {2.0, -1.0, 0.125}}, moved = given, by_types{};
  numbers change{}, change_by_number{};
  assign(by_types, accelerated<0>(a, typed.data(), given, change.data()));
  accelerate_by_number(b, counted.data(), moved, change_by_number.data());
  check_same(change, change_by_number);
  const auto parts = [](const auto& m) {
    return numbers{m.linear.x, m.linear.y, m.linear.z, m.angular.x, m.angular.y, m.angular.z};
  };
  check_same(parts(by_types), parts(moved));
  // The wrench that these accelerations need has the given power on each axis.
  const auto needed = numbers_of(accelerating_wrench(x.inertia, moved.linear, moved.angular) + x.bias);
  for (std::size_t k = 0; k < sizeof...(N); ++k)
    CHECK(std::abs(needed[static_cast<std::size_t>(axis(k))] - force(static_cast<int>(k))) <= 4 * rounding);
}

TEST_CASE("axes are eliminated alike by type and by number") {
  check_axes<3, 4, 5>();
  check_axes<0, 1, 5>();
  check_axes<0, 1, 2, 3, 4, 5>();
}

}  // namespace articulated_body_test
