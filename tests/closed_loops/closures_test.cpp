#include <kte/elements/closures.hpp>
#include <kte/kte.hpp>
#include <kte/testing/closure_laws.hpp>
#include <kte/testing/file_round_trip.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace closures_test {

using namespace kte;
using namespace kte::test;
using Catch::Matchers::Message;

/// The closure of a user: the second origin on a sphere about the first, as three functions.
struct on_sphere : closure<on_sphere> {
  static constexpr std::string_view type = "on_sphere_3D";
  static constexpr auto ports = detail::closure_ports<kind::frame_3D>;
  static constexpr closure_rows rows{1, 0};

  double radius;

  explicit constexpr on_sphere(double r) : radius(r) {}
  template <class M>
  constexpr auto residual(const M& m) const {
    return make_rows(dot(m.position, m.position) - radius * radius);
  }
  template <class M>
  constexpr auto residual_dot(const M& m) const {
    return make_rows(2 * dot(m.position, m.rotation * m.velocity));
  }
  template <class M>
  constexpr auto residual_ddot(const M& m) const {
    return make_rows(2 * (dot(m.position, m.rotation * m.acceleration) + dot(m.velocity, m.velocity)));
  }
  constexpr void check(const parameter_check& where) const { where.positive(radius, "radius must be positive"); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("radius", self.radius);
  }
};

template <class S, class Element>
void check_laws(const Element& e) {
  random_numbers draw(7);
  CHECK(testing::residual_dot_is_derivative<S>(e, draw) < by_differences<S>);
  CHECK(testing::residual_ddot_is_derivative<S>(e, draw) < by_differences<S>);
  CHECK(testing::loop_does_no_work<S>(e, draw) < rounding<S>);
  CHECK(testing::loads_are_opposite<S>(e, draw) < rounding<S>);
}
template <class Element>
void check_laws_in_both(const Element& e) {
  INFO(std::string(decltype(e.core)::type));
  check_laws<double>(e);
  check_laws<digits50>(e);
}

const vec3<> tilted{0.6, 0, 0.8}, other{0, 0.8, -0.6};

TEST_CASE("rows of closures have the derivatives of their residuals, and loads that do no work") {
  check_laws_in_both(coincident_points_2D("l", "a", "b"));
  check_laws_in_both(coincident_points_3D("l", "a", "b"));
  check_laws_in_both(coincident_frames_2D("l", "a", "b"));
  check_laws_in_both(coincident_frames_3D("l", "a", "b"));
  check_laws_in_both(hinge_3D("l", "a", "b", tilted));
  check_laws_in_both(cylindrical_3D("l", "a", "b", tilted));
  check_laws_in_both(sliding_2D("l", "a", "b", vec2<>{0.6, 0.8}));
  check_laws_in_both(sliding_3D("l", "a", "b", tilted));
  check_laws_in_both(universal_3D("l", "a", "b", tilted, other));
  check_laws_in_both(point_on_line_2D("l", "a", "b", vec2<>{0.6, 0.8}));
  check_laws_in_both(point_on_line_3D("l", "a", "b", tilted));
  check_laws_in_both(point_on_plane_3D("l", "a", "b", tilted));
  check_laws_in_both(distance_2D("l", "a", "b", 0.7));
  check_laws_in_both(distance_3D("l", "a", "b", 0.7));
  check_laws_in_both(connect(on_sphere(0.7), "a", "b", "l"));
}

TEST_CASE("the passes put residuals into loops, and their forces on frames") {
  runtime_chain c;
  c << revolute_joint_3D("q", "base", "arm", axis::z) << rigid_link_3D("arm", "tip", vec3<>{2, 0, 0})
    << point_on_plane_3D("rail", "base", "tip", axis::y);
  auto s = c.make_state();
  s.coordinate("q").q = 0.5;
  c.doMotion(s);
  CHECK(std::abs(s.loop("rail").residual.x - 2 * std::sin(0.5)) < 1e-15);
  s.loop("rail").force.x = 3;
  c.clearForce(s), c.doForce(s);
  CHECK(std::abs(s.coordinate("q").f - 3 * 2 * std::cos(0.5)) < 1e-15);
}

TEST_CASE("closures of coordinates have derivatives of their function") {
  const auto law = [](const auto& a, const auto& b) {
    using std::sin;
    return b - a * sin(b);
  };
  runtime_chain c;
  c << inertia_gen("a", 1.0) << inertia_gen("b", 1.0) << coupled_by("cam", "a", "b", law);
  auto s = c.make_state();
  s.coordinate("a").q = 0.3, s.coordinate("b").q = 0.8;
  c.doMotion(s);
  CHECK(s.loop("cam").ang_residual.x == 0.8 - 0.3 * std::sin(0.8));
  s.loop("cam").torque.x = 2;
  c.clearForce(s), c.doForce(s);
  CHECK(std::abs(s.coordinate("a").f + 2 * std::sin(0.8)) < 1e-15);
  CHECK(std::abs(s.coordinate("b").f - 2 * (1 - 0.3 * std::cos(0.8))) < 1e-15);
}

TEST_CASE("what closures refuse") {
  CHECK_THROWS_MATCHES(hinge_3D("l", "a", "b", vec3<>{1, 1, 0}), bad_parameter,
                       Message("kte: hinge_3D (frame1 'a', frame2 'b', loop 'l'): axis must have length 1, got "
                               "1.4142135623730951"));
  CHECK_THROWS_MATCHES(
      distance_2D("l", "a", "b", 0.0), bad_parameter,
      Message("kte: distance_2D (frame1 'a', frame2 'b', loop 'l'): length must be finite and positive, "
              "got 0"));
  CHECK_THROWS_AS(coupled_coordinates("l", "a", "b", 0.0, 0.0), bad_parameter);
  runtime_chain c;
  c << rigid_link_2D("root", "a", vec2<>{1, 0}) << base_2D("b") << coincident_points_2D("l", "a", "b");
  CHECK_THROWS_MATCHES(c << coincident_points_2D("l", "b", "a"), bad_wiring,
                       Message("kte: coincident_points_2D (frame1 'b', frame2 'a', loop 'l'): it writes 'l', which is "
                               "then written twice"));
  CHECK_THROWS_AS(c << coincident_points_2D("m", "a", "nowhere"), bad_wiring);
}

TEST_CASE("misspelt coordinates of closures are refused, with a similar name") {
  const auto refuses = [](const auto& closure, const std::string& what) {
    runtime_chain c;
    c << revolute_joint_2D("crank", "base", "a") << revolute_joint_2D("rocker", "base", "b") << closure;
    CHECK_THROWS_MATCHES(c.make_state(), bad_wiring, Message("kte: " + what));
    CHECK_THROWS_AS(to_chain(record_of(c)).make_state(), error);
  };
  refuses(coupled_coordinates("gear", "crank", "roker", 1.0, 2.0),
          "coupled_coordinates (coordinate1 'crank', coordinate2 'roker', loop 'gear'): nothing moves by 'roker', did "
          "you mean 'rocker'?");
  refuses(coupled_by_polynomial("cam", "cranck", "rocker", 0.0, 1.0),
          "coupled_by_polynomial (coordinate1 'cranck', coordinate2 'rocker', loop 'cam'): nothing moves by 'cranck', "
          "did you mean 'crank'?");
  runtime_chain c;
  c << revolute_joint_2D("crank", "base", "a")
    << coupled_by("cam", "crank", "other", [](const auto& x, const auto& y) { return x - y; });
  CHECK_THROWS_MATCHES(c.make_state(), bad_wiring,
                       Message("kte: coupled_by (coordinate1 'crank', coordinate2 'other', loop 'cam'): nothing moves "
                               "by 'other': is it misspelt?"));
}

}  // namespace closures_test
