#include <kte/elements/inertia.hpp>

#include <vector>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace inertia_test {

using namespace kte;
using namespace kte::test;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& inertia) {
    CHECK(testing::mass_is_that_of_force<S>(inertia, draw) <= rounding<S>);
  };
  const vec3<S> c{S(1) / 3, S(-1) / 5, S(2) / 7};
  const sym3<S> i{S(3) / 10, S(1) / 50, S(-1) / 30, S(2) / 5, S(1) / 70, S(1) / 2};
  check(inertia_gen("q", S(4) / 3));
  check(inertia_2D("frame", planar_body(S(4) / 3, S(1) / 7, vec3{S(1) / 3, S(2) / 3, zero})));
  check(inertia_2D("frame", point_mass(S(4) / 3)));
  check(inertia_3D("frame", rigid_body{S(4) / 3, c, i}));
  check(inertia_3D("frame", rigid_body{S(4) / 3, along_z(S(1) / 3), diagonal(S(1) / 3, S(1) / 4, S(1) / 5)}));
  check(inertia_3D("frame", point_mass(S(4) / 3, c)));
}

template <class S>
struct particle {
  S mass;
  vec3<S> at;
};
/// A body made of particles, in the way its user would give it: about its centre of mass.
template <class S>
rigid_body<S, vec3<S>, sym3<S>> body_of(const std::vector<particle<S>>& particles) {
  S m(0);
  vec3<S> c{};
  sym3<S> i{};
  for (const auto& p : particles) m += p.mass, c = c + p.mass * p.at;
  c = S(1 / m) * c;
  for (const auto& p : particles) {
    const auto r = p.at - c;
    const auto k = [&](const S& a, const S& b) { return S(-p.mass * a * b); };
    const S rr = p.mass * dot(r, r);
    i = i + sym3<S>{rr + k(r.x, r.x), k(r.x, r.y), k(r.x, r.z), rr + k(r.y, r.y), k(r.y, r.z), rr + k(r.z, r.z)};
  }
  return {m, c, i};
}

/// How far the load of an inertia is from D'Alembert's on its particles at p(t) + R(t) a; their
/// accelerations by numerical differentiation.
template <class Element, class S>
S off_dalembert(const Element& e, const std::vector<particle<S>>& particles, unsigned seed) {
  auto x = trial_of<S>(e, seed);
  x.doForce();
  const auto load = load_of(x.template at<0>());
  const auto& start = spatial(x.template at<0>());
  vec3<S> force{}, torque{};  // in axes of the frame
  for (const auto& p : particles) {
    const auto second = testing::detail::derivatives<S>([&](const S& t) {
                          auto y = x;
                          y.move(t);
                          const auto& f = spatial(y.template at<0>());
                          const auto at = as<S>(f.position + f.rotation * p.at);
                          return std::array<S, 3>{at.x, at.y, at.z};
                        }).second;
    const vec3<S> f = as<S>(transpose(start.rotation) * (S(-p.mass) * vec3<S>{second[0], second[1], second[2]}));
    force = force + f;
    torque = torque + cross(p.at, f);
  }
  const auto F = as<S>(load.force), T = as<S>(load.torque);
  return testing::detail::difference<S, 6>({F.x, F.y, F.z, T.x, T.y, T.z},
                                           {force.x, force.y, force.z, torque.x, torque.y, torque.z});
}

TEST_CASE("the mass of an inertia is that of its force") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("an inertia resists as its particles do") {
  using S = digits50;
  random_numbers draw(2);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::vector<particle<S>> solid, flat;
    for (int i = 0; i < 5; ++i) {
      const S mass = S(1.5 + draw());
      const vec3<S> at{S(draw()), S(draw()), S(draw())};
      solid.push_back({mass, at});
      flat.push_back({mass, {at.x, at.y, S(0)}});
    }
    CHECK(off_dalembert(inertia_3D("frame", body_of(solid)), solid, seed) <= by_differences<S>);
    const auto b = body_of(flat);
    const auto planar = planar_body(b.mass, b.inertia.zz, vec3{b.com.x, b.com.y, zero});
    CHECK(off_dalembert(inertia_2D("frame", planar), flat, seed) <= by_differences<S>);
  }
}

TEST_CASE("Euler's equations: a body that spins freely needs no torque") {
  // I al = -w x (I w), principal axes.
  const vec3 w{0.5, -2.0, 1.5};
  const double A = 0.75, B = 0.5, C = 1.0;
  auto x = trial_of(inertia_3D("frame", rigid_body{2.0, zero3{}, diagonal(A, B, C)}), 1);
  x.at<0>() = {.ang_velocity = w,
               .ang_acceleration = {(B - C) / A * w.y * w.z, (C - A) / B * w.z * w.x, (A - B) / C * w.x * w.y}};
  x.doForce();
  CHECK(near(x.at<0>().torque, zero3{}, 4 * eps<double>));
  CHECK(x.at<0>().force == vec3{0.0, 0.0, 0.0});
}

TEST_CASE("a mass off the axis pulls outwards") {
  auto x = trial_of(inertia_3D("frame", point_mass(3.0, vec3{0.5, zero, 0.25})), 1);
  x.at<0>() = {.ang_velocity = {0.0, 0.0, 4.0}};
  x.doForce();
  CHECK(x.at<0>().force == vec3{24.0, 0.0, 0.0});        // m w^2 r
  CHECK(x.at<0>().torque == vec3{0.0, 0.25 * 24, 0.0});  // c x F
  x.at<0>() = {.acceleration = {0.0, 9.5, 0.0}};
  x.doForce();
  CHECK(x.at<0>().force == vec3{0.0, -28.5, 0.0});
  CHECK(x.at<0>().torque == vec3{0.25 * 28.5, 0.0, -0.5 * 28.5});
}

TEST_CASE("an inertia keeps NaN") {
  auto x = trial_of(inertia_2D("frame", planar_body(1, 1)), 1);
  x.at<0>().acceleration.x = not_a_number;
  x.doForce();
  CHECK(std::isnan(x.at<0>().force.x));
}

TEST_CASE("an inertia wants a physical body") {
  const std::string where = "kte: inertia_3D (frame 'forearm'): ";
  const auto what = [](const auto& body) { return complaint([&] { (void)inertia_3D("forearm", body); }); };
  const auto with = [&](const sym3<>& i) { return what(rigid_body{1.0, zero3{}, i}); };
  const auto diagonal_of = [&](double a, double b, double c) { return with({a, 0, 0, b, 0, c}); };

  CHECK(what(point_mass(-1.5)) == where + "mass must be finite and not negative, got -1.5");
  CHECK(what(point_mass(not_a_number)) == where + "mass must be finite and not negative, got nan");
  CHECK(what(point_mass(infinity)) == where + "mass must be finite and not negative, got inf");
  CHECK(what(point_mass(0.0)) == "");
  CHECK(what(point_mass(1.0, along_y(not_a_number))) == where + "centre of mass must be finite, got nan");
  CHECK(what(point_mass(1.0, along_y(-infinity))) == where + "centre of mass must be finite, got -inf");

  const std::string physical = where +
                               "inertia must be physical: no principal moment above the sum of the other two "
                               "(rigid_body{...}.as_published() is not checked for this), but ";
  CHECK(diagonal_of(1, 1, 2.5) == physical + "2.5 is above 1 + 1 by 0.5");  // flatter than flat
  CHECK(diagonal_of(3, 1, 1) == physical + "3 is above 1 + 1 by 1");
  CHECK(diagonal_of(1, 5, 1) == physical + "5 is above 1 + 1 by 3");
  CHECK(diagonal_of(0.00191, 0.00846, 0.01059) == physical + "0.01059 is above 0.00846 + 0.00191 by 0.00022");
  CHECK(diagonal_of(-1, 1, 1).starts_with(physical));
  CHECK(diagonal_of(-1, -1, -1).starts_with(physical));
  CHECK(with({1, 2, 0, 1, 0, 1}) == physical + "3 is above 1 + -1 by 3");  // not positive definite
  CHECK(with({1, 0, 0, 1, -2, 1}) == physical + "3 is above 1 + -1 by 3");
  // Principal moments 1 + 2 p, 1 - p, 1 - p with all products p: the first at most the sum of the others if p <= 1/4.
  CHECK(with({1, 0.2499, 0.2499, 1, 0.2499, 1}) == "");
  CHECK(with({1, -0.4999, -0.4999, 1, -0.4999, 1}) == "");
  CHECK(with({1, 0.2501, 0.2501, 1, 0.2501, 1}).starts_with(physical));
  CHECK(with({1, -0.5001, -0.5001, 1, -0.5001, 1}).starts_with(physical));
  CHECK(diagonal_of(not_a_number, 1, 1) == where + "inertia must be finite, got nan");
  CHECK(diagonal_of(1, 1, infinity) == where + "inertia must be finite, got inf");
  CHECK(with({1, 0, not_a_number, 1, 0, 1}) == where + "inertia must be finite, got nan");
  CHECK(diagonal_of(0, 1, 1) == "");  // a rod
  CHECK(diagonal_of(1, 1, 2) == "");  // a plate
  CHECK(diagonal_of(1.234, 1.111, 2.345) == "");
  CHECK(diagonal_of(0, 0, 0) == "");

  CHECK(complaint([] { (void)inertia_2D("f", planar_body(1.0, -0.5)); }) ==
        "kte: inertia_2D (frame 'f'): inertia must be finite and not negative, got -0.5");
  CHECK(complaint([] { (void)inertia_gen("rotor", -0.25); }) ==
        "kte: inertia_gen (coordinate 'rotor'): mass must be finite and not negative, got -0.25");
  CHECK(complaint([] { (void)inertia_gen("rotor", not_a_number); }) ==
        "kte: inertia_gen (coordinate 'rotor'): mass must be finite and not negative, got nan");
}

TEST_CASE("a published body") {
  // The frame of a published robot's upper arm, 2 % above the triangle inequality: only by name.
  const rigid_body arm{1.42, vec3{0.03, -0.01, 0.04}, sym3{0.00191, 0.0, 0.0, 0.00846, 0.0, 0.01059}};
  CHECK(complaint([&] { (void)inertia_3D("arm", arm); }).find("0.01059 is above 0.00846 + 0.00191") !=
        std::string::npos);
  CHECK(complaint([&] { (void)inertia_3D("arm", arm.as_published()); }) == "");
  CHECK(complaint([] { (void)inertia_2D("arm", planar_body(1.0, -0.5).as_published()); }) == "");
  constexpr struct key final : frame_3D_key<"arm"> {
  } arm_key;
  constexpr auto published = inertia_3D(arm_key, rigid_body{1.0, zero3{}, diagonal(1.0, 1.0, 3.0)}.as_published());
  CHECK(published.core.body.published);
  // Conditions that are still checked.
  const auto what = [](const auto& body) { return complaint([&] { (void)inertia_3D("arm", body.as_published()); }); };
  const std::string where = "kte: inertia_3D (frame 'arm'): ";
  CHECK(what(point_mass(-1.0)) == where + "mass must be finite and not negative, got -1");
  CHECK(what(point_mass(1.0, along_y(infinity))) == where + "centre of mass must be finite, got inf");
  CHECK(what(rigid_body{1.0, zero3{}, sym3{1.0, 0.0, not_a_number, 1.0, 0.0, 1.0}}) ==
        where + "inertia must be finite, got nan");
}

TEST_CASE("an inertia is physical to the digits of the body about its frame") {
  // Bodies that were lumped into one: what is left about the centre of mass is rounding of m |c|^2.
  const auto what = [](const auto& body) { return complaint([&] { (void)inertia_3D("lump", body); }); };
  CHECK(what(rigid_body{0.5, vec3{0.1, 0.0, -0.2}, sym3{3e-18, 1e-18, 0.0, -1e-18, 0.0, 8e-18}}) == "");
  CHECK(what(rigid_body{0.5, vec3{0.1, 0.0, -0.2}, diagonal(0.0, 0.0, 1e-10)}) != "");
  CHECK(what(rigid_body{0.5, zero3{}, sym3{3e-18, 1e-18, 0.0, -1e-18, 0.0, 8e-18}}) != "");
}

}  // namespace inertia_test
