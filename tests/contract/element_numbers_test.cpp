#include <kte/contract/element_numbers.hpp>
#include <kte/contract/port.hpp>
#include <kte/contract/rigid_numbers.hpp>

#include "catch.hpp"
#include "chain/models.hpp"

// What elements are to the loops over body nodes, as numbers.

namespace element_numbers_test {

using namespace kte;
using namespace kte::detail;
using kte::test::within;

template <class P = double, class Core, class... Keys>
element_numbers<P> numbers_of_element(const element<Core, Keys...>& e) {
  return numbers_of<P>(e.core);
}
template <class A, class B>
double gap(const vec3<A>& a, const vec3<B>& b) {
  const auto d = a - b;
  return std::sqrt(static_cast<double>(dot(d, d)));
}

TEST_CASE("a joint is where it stands at zero, where it is tried, and its axis") {
  using namespace models;
  const auto n = numbers_of_element(revolute_joint_3D(hip, ground, trunk, vec3{0.6, 0.0, 0.8}));
  CHECK(n.is == part::rigid);
  CHECK(n.plain_loads);
  CHECK(n.rigid.at_zero.position == vec3<>{});
  CHECK(n.rigid.at_zero.rotation == as<double>(matrix(no_rotation{})));
  CHECK(gap(n.rigid.angular[0], vec3{0.6, 0.0, 0.8}) < 1e-16);
  CHECK(n.rigid.linear[0] == vec3<>{});
  // About (0.6, 0, 0.8) by atan 3/4 (Rodrigues): y goes to 0.8 y + 0.6 (w x y).
  const auto& r = n.rigid.tried.rotation;
  CHECK(gap(vec3{r.x.y, r.y.y, r.z.y}, vec3{-0.48, 0.8, 0.36}) < 2e-16);

  const auto slides = numbers_of_element(prismatic_joint_3D(slide, ground, trunk, axis::minus_y));
  CHECK(slides.rigid.linear[0] == vec3{0.0, -1.0, 0.0});
  CHECK(slides.rigid.angular[0] == vec3<>{});
  CHECK(slides.rigid.tried.position.y == within(-tried_angle, 1e-16));
}

TEST_CASE("a link is a pose, a body its numbers about its centre of mass, a rotor a mass") {
  using namespace models;
  const auto link = numbers_of_element(rigid_link_3D(trunk, left, vec3{0.1, 0.2, -0.3}, quarter_turn_x));
  CHECK(link.is == part::rigid);
  CHECK(link.rigid.at_zero.position == vec3{0.1, 0.2, -0.3});
  CHECK(link.rigid.at_zero.rotation.z == vec3{0.0, 1.0, 0.0});

  const auto body = numbers_of_element(inertia_3D(trunk, rigid_body{2.0, along_x(0.5), diagonal(0.1, 0.2, 0.25)}));
  CHECK(body.is == part::body);
  CHECK(!body.has_mass);  // on a coordinate
  CHECK(body.body.mass == 2);
  CHECK(body.body.com == vec3{0.5, 0.0, 0.0});
  CHECK(body.body.inertia.yy == 0.2);
  CHECK(body.weight.moment == vec3{1.0, 0.0, 0.0});
  CHECK(body.weight.inertia.yy == within(0.2 + 2 * 0.25, 1e-16));  // about the origin

  const auto rotor = numbers_of_element(inertia_gen(hip, 0.05));
  CHECK(rotor.is == part::body);
  CHECK(rotor.has_mass);
  CHECK(rotor.mass == 0.05);
  CHECK(numbers_of_element(inertia_gen(hip, 0.0)).has_mass);
}

TEST_CASE("what else there is has its own force law") {
  using namespace models;
  CHECK(numbers_of_element(base_gen(wall)).is == part::base);
  CHECK(numbers_of_element(rigid_link_gen(knee, geared, 0.3)).is == part::follower);
  CHECK(numbers_of_element(spring_gen(hip, knee, 0.1, 3.0)).is == part::force);
  const auto core_acts = []<class Core, class... Keys>(const element<Core, Keys...>&) { return acts<Core>; };
  CHECK(core_acts(spring_gen(hip, knee, 0.1, 3.0)));
  CHECK(core_acts(rigid_link_gen(knee, geared, 0.3)));
  CHECK(!core_acts(base_gen(wall)));
  CHECK(!core_acts(inertia_gen(hip, 0.05)));
  CHECK(!core_acts(inertia_3D(trunk, point_mass(1.0))));
  CHECK(!core_acts(rigid_link_3D(trunk, left, along_y(1.0))));
}

TEST_CASE("numbers of elements in another precision") {
  using namespace models;
  const auto joint = revolute_joint_3D(hip, ground, trunk, vec3{0.6, 0.0, 0.8});
  const auto exact = numbers_of_element<long double>(joint);
  const auto cast = as_numbers<long double>(numbers_of_element(joint));
  CHECK(cast.is == exact.is);
  CHECK(gap(cast.rigid.angular[0], exact.rigid.angular[0]) == 0);
  CHECK(gap(cast.rigid.tried.rotation.y, exact.rigid.tried.rotation.y) < 2e-16);  // which was rounded to double
  const auto small = as_numbers<float>(numbers_of_element(inertia_gen(hip, 0.1)));
  CHECK(small.mass == 0.1f);
  CHECK(small.has_mass);
}

TEST_CASE("ports say what they write and declare") {
  constexpr port out{kind::gen, access::out, "end"}, base{kind::gen, access::base, "coordinate"},
      kept{kind::internal, access::keep, "bristles"}, angle{kind::gen, access::angle, "coordinate"};
  CHECK((out.writes() && out.declares()));
  CHECK((base.writes() && base.declares()));
  CHECK((!kept.writes() && kept.declares()));
  CHECK((!angle.writes() && !angle.declares()));
}

}  // namespace element_numbers_test
