#include <kte/contact/height_field.hpp>
#include <kte/contact/surface.hpp>
#include <kte/elements/bristle_contact.hpp>
#include <kte/elements/compliant_contact.hpp>
#include <kte/elements/compliant_shapes.hpp>
#include <kte/testing/file_round_trip.hpp>
#include <kte/testing/static_is_runtime.hpp>
#include <kte/static.hpp>

#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

using namespace kte;
using namespace kte::test;

namespace {

constexpr compliant_contact_parameters rubber{
    .stiffness = 3, .exponent = 1.5, .dissipation = 0.25, .friction = 0.5, .slip_speed = 0.125};
constexpr compliant_contact_parameters spring{.stiffness = 3, .exponent = 3};
constexpr bristle_contact_parameters brush{.stiffness = 3,
                                           .dissipation = 0.25,
                                           .friction = 0.5,
                                           .slip_speed = 0.125,
                                           .bristle_stiffness = 2,
                                           .bristle_damping = 0.5};
const auto waves = [](const auto& x, const auto& y) {
  using std::sin;
  return 0.1 * sin(x) + 0.15 * x * y;
};
const auto hill = [](const auto& x) { return 0.3 * x * x; };
const auto slope = [](const auto& p) { return 0.6 * p.x + 0.8 * p.y; };

/// The motion of the second frame in the first, and the force on it at the contact, in axes of the first.
template <class S, class Trial>
auto relative_motion(Trial& x) {
  return detail::as_closing_motion<S>(relative(spatial(x.template at<0>()), spatial(x.template at<1>())));
}
/// The loads of a contact do the work of its force on the slip.
template <class S, class Element>
S power_is_force_times_slip(const Element& e, random_numbers& draw) {
  return testing::detail::worst_of_many<S>(e.core, draw, [&e](auto& x) {
    x.doForce();
    const auto m = relative_motion<S>(x);
    const vec3<S> force = as<S>(m.rotation * load_of(x.template at<1>()).force);
    const auto u = e.core.geometry.slip(m);
    S sum = -dot(force, u), sizes = testing::detail::magnitude(sum);
    x.for_each([&](const port&, auto& thing) {
      const auto [p, s] = testing::detail::power(thing);
      sum = sum + p, sizes = sizes + s;
    });
    return testing::detail::ratio(sum, sizes);
  });
}
template <class S, class Element>
void check_laws(const Element& e) {
  random_numbers draw(3);
  CHECK(testing::loads_are_opposite<S>(e, draw) <= rounding<S>);
  CHECK(testing::same_anywhere<S>(e, draw) <= 8 * rounding<S>);
  CHECK(power_is_force_times_slip<S>(e, draw) <= rounding<S>);
}
template <class Element>
void check_laws_in_both(const Element& e) {
  check_laws<double>(e);
  check_laws<digits50>(e);
}

}  // namespace

TEST_CASE("forces of compliant contacts are opposite, and independent of their place", "[laws]") {
  check_laws_in_both(compliant_contact_3D("a", "b", half_space{}, 0.7, rubber));
  check_laws_in_both(compliant_contact_2D("a", "b", half_space{}, 0.7, rubber));
  check_laws_in_both(compliant_contact_3D("a", "b", ball(0.7), 0.7, rubber, vec3{0.1, 0.2, 0.3}));
  check_laws_in_both(compliant_contact_3D("a", "b", bowl(0.7), 0.2, rubber));
  check_laws_in_both(compliant_contact_3D("a", "b", cylinder(0.7), 0.2, rubber));
  check_laws_in_both(compliant_contact_3D("a", "b", height_field(waves), 0, rubber));
  check_laws_in_both(compliant_contact_2D("a", "b", height_field(hill), 0.1, rubber, vec2{0.1, 0.2}));
  check_laws_in_both(compliant_contact_2D("a", "b", surface(slope), 0, rubber));
  check_laws_in_both(compliant_disc_contact_3D("a", "b", half_space{}, axis::y, 0.7, rubber));
  check_laws_in_both(bristle_contact_3D("a", "b", "x", "y", "z", half_space{}, 0.7, brush));
  check_laws_in_both(bristle_contact_2D("a", "b", "z", half_space{}, 0.7, brush));
}
