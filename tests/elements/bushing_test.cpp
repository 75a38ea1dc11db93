#include <kte/elements/bushing.hpp>
#include <kte/math/dual.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "digits100.hpp"
#include "elements/laws.hpp"

namespace bushing_test {

using namespace kte;
using namespace kte::test;

/// Not negative: a unit matrix and a Gram matrix of three columns.
constexpr bushing_matrix coupled_all{sym3{6.0, 1.0, 0.5, 5.0, -1.0, 7.0}, sym3{4.0, 0.5, 0.0, 3.0, 1.0, 5.0},
                                     mat3{vec3{0.5, 1.0, -0.5}, vec3{0.0, 0.25, 1.0}, vec3{-1.0, 0.5, 0.0}}};
constexpr vec3 rest{0.3, -0.2, 0.5};

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto spring = bushing_3D("a", "b", coupled_all, {}, rest), damper = bushing_3D("a", "b", {}, coupled_all),
             both = bushing_3D("a", "b", coupled_all, coupled_all, rest);
  CHECK(testing::force_is_gradient<S>(spring, draw, energy_of(spring)) <= 20 * by_differences<S>);
  CHECK(testing::no_work_done<S>(damper, draw) == 0);
  CHECK(testing::loads_are_opposite<S>(both, draw) <= 4 * rounding<S>);
  CHECK(change_when_moved<S>(both, draw) <= 4 * rounding<S>);
}
std::array<frame_3D<>, 2> loaded(const bushing_matrix& k, const bushing_matrix& c, const frame_3D<>& second) {
  auto x = trial_of(bushing_3D("a", "b", k, c, rest), 1);
  x.at<0>() = {}, x.at<1>() = second;
  x.doForce();
  return {x.at<0>(), x.at<1>()};
}

TEST_CASE("bushings obey the laws") { check_laws<double>(), check_laws<digits50>(); }

TEST_CASE("functions of half a turn keep their digits where they change to series") {
  const auto errors = []<class S>(const S& t) {
    using variable = dual<S, 1>;
    variable tt(t * t);
    tt.derivative[0] = 1;
    const auto x = detail::half_turn_functions_of(tt);
    // By the formulas, and derivatives by t^2 by hand, in more digits than they lose.
    const digits100 T = to_100(t), s = sin(T / 2) / T, c = cos(T / 2), k = (1 - 1 / (2 * s)) / (T * T);
    const digits100 s_dot = (c / 2 - s) / (2 * T * T), c_dot = -s / 4, k_dot = (s_dot / (2 * s * s) - k) / (T * T);
    const auto off = [](const S& y, const digits100& exact, const digits100& factor) {
      return from_100<S>(factor * abs(to_100(y) - exact));
    };
    // Each with the powers of t by which it comes into loads and their derivatives.
    return std::array{off(x.s.value, s, 1),
                      off(x.c.value, c, 1),
                      off(x.k.value, k, T * T),
                      off(x.s.derivative[0], s_dot, T * T),
                      off(x.c.derivative[0], c_dot, T * T),
                      off(x.k.derivative[0], k_dot, T * T * T * T)};
  };
  for (const double t : {1e-9, 1e-3, 0.0110, 0.0111, 0.5, 3.0})
    for (const double e : errors(t)) CHECK(e <= 4 * eps<double>);
  for (const digits50& t : {digits50(1e-20), digits50("1.2e-7"), digits50("9.1e-7"), digits50("9.3e-7"), digits50(1)})
    for (const digits50& e : errors(t)) CHECK(e <= 4 * eps<digits50>);
}

TEST_CASE("the rates by which a bushing is damped are derivatives") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    auto x = trial_of<digits50>(bushing_3D("a", "b", {}), seed);
    const auto seen = [](auto& y) {
      return detail::midway_between<kind::frame_3D>(spatial(y.template at<0>()), spatial(y.template at<1>()));
    };
    const auto change = testing::detail::derivatives<digits50>([&](const digits50& t) {
      auto y = x;
      y.move(t);
      const auto m = seen(y);
      return std::array{m.d.x, m.d.y, m.d.z, m.r.x, m.r.y, m.r.z};
    });
    const auto rates = detail::midway_rates_of(seen(x), x.at<0>(), x.at<1>());
    const std::array given{rates.d.x, rates.d.y, rates.d.z, rates.r.x, rates.r.y, rates.r.z};
    CHECK(testing::detail::difference<digits50, 6>(given, change.first) <= 1000 * by_differences<digits50>);
  }
}

TEST_CASE("a bushing resists what it is moved by") {
  const double margin = 32 * eps<double>;
  // Moved along, it is its matrix.
  const vec3 u{0.1, -0.3, 0.2};
  const auto moved = loaded(coupled_all, {}, {.position = rest + u});
  CHECK(near(moved[1].force, -(coupled_all.linear * u), margin));
  CHECK(near(moved[1].torque, 0.5 * cross(moved[1].force, rest + u) - transpose(coupled_all.coupling) * u, margin));
  // Turned by r about where it is at rest, the frame halfway is turned by r/2: an isotropic one knows no direction.
  const vec3 r{0.5, 0.75, 1.5};
  const auto turned = loaded(isotropic_bushing(0, 3), {}, {.position = rest, .rotation = matrix(r)});
  CHECK(near(turned[0].torque, 3.0 * r, margin));
  CHECK(near(turned[1].torque, -3.0 * r, margin));
  // Rates along and about an axis.
  const auto fast = loaded({}, isotropic_bushing(2, 3), {.velocity = {1, 0, 0}, .ang_velocity = {0, 0, 4}});
  CHECK(near(fast[1].force, vec3{-2.0, 0.0, 0.0}, margin));
  CHECK(near(fast[1].torque, vec3{0.0, 0.0, -12.0}, margin));
  const vec3 v{1.0, -2.0, 0.5}, w{0.25, 1.5, -1.0};
  const auto whirled = loaded({}, coupled_all, {.velocity = v, .ang_velocity = w});  // both origins in one place
  CHECK(near(whirled[1].force, -(coupled_all.linear * v + coupled_all.coupling * w), margin));
  CHECK(near(whirled[1].torque, -(transpose(coupled_all.coupling) * v + coupled_all.angular * w), margin));
  CHECK(std::isnan(loaded(coupled_all, {}, {.position = {not_a_number, 0, 0}})[0].torque.x));
}

TEST_CASE("bushings are saved and loaded, and reject matrices that give work away") {
  runtime_chain c;
  c << base_3D("a") << base_3D("b") << bushing_3D("a", "b", coupled_all, isotropic_bushing(1, 2), rest);
  CHECK(record_of(models::registered(record_of(c))) == record_of(c));
  const auto what = [](const bushing_matrix& k, const bushing_matrix& damping = {}) {
    return complaint([&] { (void)bushing_3D("a", "b", k, damping); });
  };
  const std::string where = "kte: bushing_3D (anchor1 'a', anchor2 'b'): ";
  const auto coupled = [](double strength) {
    const mat3 z{vec3{strength, 0.0, 0.0}, vec3{0.0, 0.0, 0.0}, vec3{0.0, 0.0, 0.0}};
    return bushing_matrix(diagonal(2.0, 1.0, 0.0), diagonal(8.0, 0.0, 0.0), z);
  };
  CHECK(what(coupled(4.0)) == "");  // on the edge: 16 = 2 times 8
  CHECK(what(coupled(4.001)).starts_with(where + "stiffness must have no negative eigenvalue"));
  CHECK(what(isotropic_bushing(1, -1)).starts_with(where + "stiffness must have no negative eigenvalue"));
  CHECK(what({}, {diagonal(0.0, 1.0, 1.0), sym3{}, mat3{vec3{0.0, 1e-3, 0.0}, vec3<>{}, vec3<>{}}})
            .starts_with(where + "damping must have no negative eigenvalue"));
  CHECK(what(isotropic_bushing(not_a_number, 1)).starts_with(where + "stiffness must be finite"));
}

}  // namespace bushing_test
