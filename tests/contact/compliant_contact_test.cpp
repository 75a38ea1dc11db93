#include <kte/contact/height_field.hpp>
#include <kte/contact/surface.hpp>
#include <kte/elements/bristle_contact.hpp>
#include <kte/elements/compliant_contact.hpp>
#include <kte/elements/compliant_shapes.hpp>
#include <kte/math/pack_functions.hpp>
#include <kte/static.hpp>
#include <kte/testing/file_round_trip.hpp>
#include <kte/testing/static_is_runtime.hpp>

#include <numbers>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace compliant_contact_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct body_   final : frame_3D_key<"body">   {} body;
inline constexpr struct hair_x_ final : internal_key<"hair_x"> {} hair_x;
inline constexpr struct hair_y_ final : internal_key<"hair_y"> {} hair_y;
inline constexpr struct hair_z_ final : internal_key<"hair_z"> {} hair_z;
// clang-format on

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
const auto flat = [](const auto& x, const auto& y) { return 0.0 * (x + y); };
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

TEST_CASE("forces of compliant contacts are opposite, and independent of their place") {
  check_laws_in_both(compliant_contact_3D("a", "b", half_space{}, 0.7, rubber));
  check_laws_in_both(compliant_contact_2D("a", "b", half_space{}, 0.7, rubber));
  check_laws_in_both(compliant_contact_3D("a", "b", ball_surface(0.7), 0.7, rubber, vec3{0.1, 0.2, 0.3}));
  check_laws_in_both(compliant_contact_3D("a", "b", bowl_surface(0.7), 0.2, rubber));
  check_laws_in_both(compliant_contact_3D("a", "b", cylinder_surface(0.7), 0.2, rubber));
  check_laws_in_both(compliant_contact_3D("a", "b", height_field(waves), 0, rubber));
  check_laws_in_both(compliant_contact_2D("a", "b", height_field(hill), 0.1, rubber, vec2{0.1, 0.2}));
  check_laws_in_both(compliant_contact_2D("a", "b", surface(slope), 0, rubber));
  check_laws_in_both(compliant_disc_contact_3D("a", "b", half_space{}, axis::y, 0.7, rubber));
  check_laws_in_both(bristle_contact_3D("a", "b", "x", "y", "z", half_space{}, 0.7, brush));
  check_laws_in_both(bristle_contact_2D("a", "b", "z", half_space{}, 0.7, brush));
}

TEST_CASE("without dissipation and friction the force is the gradient of the energy") {
  random_numbers draw(4);
  const auto check = [&draw](const auto& e) {
    CHECK(testing::force_is_gradient<digits50>(e, draw, energy_of(e)) < 20 * by_differences<digits50>);
  };
  check(compliant_contact_3D("a", "b", half_space{}, 0.7, spring));
  check(compliant_contact_2D("a", "b", ball_surface(0.75), 0.5, spring, vec2{0.25, 0.5}));
  check(compliant_contact_3D("a", "b", bowl_surface(0.75), 0.25, spring));
  check(compliant_contact_3D("a", "b", height_field(waves), 0.25, spring));
  check(compliant_disc_contact_3D("a", "b", half_space{}, axis::y, 0.75, spring));
}

TEST_CASE("friction and dissipation take power") {
  random_numbers draw(5);
  const auto check = [&draw](const auto& e) {
    CHECK(testing::detail::worst_of_many<double>(e.core, draw, [&e](auto& x) {
            auto still = e.core;
            still.p.dissipation = still.p.friction = 0;
            auto y = x.with(still);
            x.doForce();
            const auto m = relative_motion<double>(x);
            const vec3<> force = m.rotation * as<double>(load_of(x.template at<1>()).force);
            y.doForce();
            const vec3<> elastic = m.rotation * as<double>(load_of(y.template at<1>()).force);
            return (std::max)(0.0, dot(force - elastic, e.core.geometry.slip(m)));
          }) == 0);
  };
  check(compliant_contact_3D("a", "b", half_space{}, 0.7, rubber));
  check(compliant_contact_2D("a", "b", ball_surface(0.75), 0.5, rubber));
}

TEST_CASE("a contact by hand") {
  // A sphere of radius 0.5 at the height 0.25, which falls at 2 m/s and slides at 1.5 m/s, without rotation.
  auto x = trial_of(
      compliant_contact_3D("a", "b", half_space{}, 0.5,
                           {.stiffness = 8, .exponent = 2, .dissipation = 0.5, .friction = 0.5, .slip_speed = 2}),
      1);
  x.at<0>() = {}, x.at<1>() = {};
  x.at<1>().position = {0, 0, 0.25}, x.at<1>().velocity = {1.5, 0, -2};
  x.doForce();
  const double pressure = 8 * 0.0625 * 2, friction = 0.5 * pressure * 1.5 / 2.5;
  CHECK(near(x.at<1>().force, vec3<>{-friction, 0, pressure}, 1e-15));
  CHECK(near(x.at<1>().torque, vec3<>{0, 0.5 * friction, 0}, 1e-15));
  CHECK(near(x.at<0>().force, vec3<>{friction, 0, -pressure}, 1e-15));
  x.at<1>().position.z = 0.75;
  x.at<0>().force = x.at<1>().force = {};
  x.doForce();
  CHECK(x.at<1>().force == vec3<>{});
  x.at<1>().position.z = 0.25, x.at<1>().velocity.z = 4;  // it separates so fast that it would stick
  x.doForce();
  CHECK(x.at<1>().force == vec3<>{});
}

TEST_CASE("contacts of capsules and boxes are those of their ends and corners") {
  runtime_chain c;
  c << base_3D("ground") << base_3D("box") << base_3D("capsule") << base_2D("floor") << base_2D("card")
    << compliant_box_contact_3D("ground", "box", half_space{}, vec3{1, 2, 3}, rubber)
    << compliant_capsule_contact_3D("ground", "capsule", half_space{}, along_x(1.0), 0.25, rubber)
    << compliant_box_contact_2D("floor", "card", half_space{}, vec2{1.0, 2.0}, rubber);
  auto s = c.make_state();
  s.frame_3D("box").position.z = 2.75, s.frame_3D("capsule").position.z = 0, s.frame_2D("card").position.y = 1.75;
  c.doMotion(s), c.doForce(s);
  const double corner = 3 * std::pow(0.25, 1.5);
  CHECK(near(s.frame_3D("box").force, vec3<>{0, 0, 4 * corner}, 1e-15));
  CHECK(near(s.frame_3D("capsule").force, vec3<>{0, 0, 2 * corner}, 1e-15));
  CHECK(s.frame_2D("card").force.y == within(2 * corner, 1e-15));
  CHECK(near(s.frame_3D("ground").force, vec3<>{0, 0, -6 * corner}, 1e-14));

  runtime_chain leaning;
  leaning << base_2D("floor") << base_2D("card")
          << compliant_capsule_contact_2D("floor", "card", half_space{}, vec2{1.0, 2.0}, 0, rubber);
  auto x = leaning.make_state();
  x.frame_2D("card").position.y = 1.75;
  leaning.doMotion(x), leaning.doForce(x);
  CHECK(x.frame_2D("card").force.y == within(corner, 1e-15));
  CHECK(x.frame_2D("card").torque == within(-corner, 1e-15));
}

TEST_CASE("bad parameters of contacts are refused by name") {
  const auto what = [](compliant_contact_parameters p) {
    return complaint([&] { (void)compliant_contact_3D("a", "b", half_space{}, 0.1, p); });
  };
  const std::string element = "kte: compliant_contact_3D (frame1 'a', frame2 'b'): ";
  CHECK(what({.stiffness = 0}) == element + "stiffness must be finite and positive, got 0");
  CHECK(what({.stiffness = 1, .exponent = 0.5}) == element + "exponent must be finite and not below 1, got 0.5");
  CHECK(what({.stiffness = 1, .dissipation = -1}) == element + "dissipation must be finite and not negative, got -1");
  CHECK(what({.stiffness = 1, .friction = -1}) == element + "friction must be finite and not negative, got -1");
  CHECK(what({.stiffness = 1, .slip_speed = 0}) == element + "slip_speed must be finite and positive, got 0");
  CHECK(what({.stiffness = not_a_number}) == element + "stiffness must be finite and positive, got nan");
  CHECK(complaint([] { (void)compliant_contact_3D("a", "b", half_space{}, -1, rubber); }) ==
        element + "radius must be finite and not negative, got -1");
  CHECK(complaint([] { (void)compliant_contact_3D("a", "b", bowl_surface(0.5), 0.5, rubber); }) ==
        element + "radius must be below that of the bowl, got 0.5");
  CHECK(complaint([] {
          (void)compliant_contact_3D("a", "b", half_space(vec3{0, 0, 2}), 0.5, rubber);
        }) == element + "surface_axis must have length 1, or be zero with a surface_radius, got 2");
  CHECK(complaint([] {
          (void)compliant_contact_2D("a", "b", half_space(vec3{0, 0, 1}), 0.5, rubber);
        }) ==
        "kte: compliant_contact_2D (frame1 'a', frame2 'b'): the normal surface_axis must be in the plane, got 1");
  CHECK(complaint([] { (void)ball_surface(-1); }) ==
        "kte: the radius of a ball, bowl or cylinder must be finite and positive, got -1");
  CHECK(complaint([] { (void)half_space(vec3<>{}); }) == "kte: the normal of a half space must have length 1, got 0");
  auto soft = brush;
  soft.friction = 0;
  CHECK(complaint([&] { (void)bristle_contact_2D("a", "b", "z", half_space{}, 0.5, soft); }) ==
        "kte: bristle_contact_2D (frame1 'a', frame2 'b', bristles 'z'): friction must be finite and positive, got 0");
}

TEST_CASE("contacts are equal in static and runtime chains") {
  random_numbers draw(6);
  CHECK(testing::static_is_runtime(compliant_contact_3D("a", "b", half_space{}, 0.7, rubber), draw) < 1e-14);
  CHECK(testing::static_is_runtime(compliant_contact_2D("a", "b", ball_surface(0.7), 0.7, rubber), draw) < 1e-14);
  CHECK(testing::static_is_runtime(compliant_disc_contact_3D("a", "b", half_space{}, axis::y, 0.7, rubber), draw) <
        1e-14);
  CHECK(testing::static_is_runtime(bristle_contact_3D("a", "b", "x", "y", "z", half_space{}, 0.7, brush), draw) <
        1e-14);
  CHECK(testing::static_is_runtime(bristle_contact_2D("a", "b", "z", half_space{}, 0.7, brush), draw) < 1e-14);
}

TEST_CASE("contacts take packs, where some states touch and others do not") {
  const auto check = [](const auto& e) {
    const auto c = chain(base_3D(ground), base_3D(body), e);
    const auto put = [](auto& frame, const auto& height) {
      using S = std::remove_cvref_t<decltype(height)>;
      frame.position = {S(0.1), S(0.2), height}, frame.velocity = {S(1), S(2), S(-0.5)}, frame.ang_velocity.x = S(3);
    };
    const auto height = [](std::size_t i) { return 0.5 + 0.15 * static_cast<double>(i); };
    auto packed = make_state<pack<double, 4>>(c);
    pack<double, 4> heights(0.0);
    for (std::size_t i = 0; i < 4; ++i) heights.set(i, height(i));
    put(packed[body], heights);
    c.doForce(packed);
    for (std::size_t i = 0; i < 4; ++i) {
      auto alone = make_state(c);
      put(alone[body], height(i));
      c.doForce(alone);
      const auto& f = alone[body].force;
      const auto& of_pack = packed[body].force;
      CHECK(near(vec3<>{of_pack.x[i], of_pack.y[i], of_pack.z[i]}, f, 1e-14));
      CHECK((f.z > 0) == (i < 2));
    }
  };
  check(compliant_contact_3D(ground, body, half_space{}, 0.7, rubber));
  check(bristle_contact_3D(ground, body, hair_x, hair_y, hair_z, half_space{}, 0.7, brush));
  check(compliant_contact_3D(ground, body, height_field(flat), 0.7, rubber));
}

}  // namespace compliant_contact_test
