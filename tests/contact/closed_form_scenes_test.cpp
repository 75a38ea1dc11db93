#include <kte/contacts.hpp>
#include <kte/elements/law_signal.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/simulation.hpp>
#include <kte/static.hpp>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"

namespace closed_form_scenes_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

/// Scenes of rigid contact whose motion is known in closed form, by events.

constexpr double g = 9.81, ball_radius = 0.1, beta = 0.4;  // of a ball of 1 kg: I = beta m r^2
using model_type = manipulator_dynamics_model<runtime_chain>;

/// A disc or block of 1 kg in the plane: frame "body".
runtime_chain planar(double inertia) {
  runtime_chain c;
  c.gravity(vec3<>{0, -g, 0}) << base_2D("world") << prismatic_joint_2D("x", "world", "bx", axis::x)
                              << prismatic_joint_2D("y", "bx", "by", axis::y)
                              << revolute_joint_2D("angle", "by", "body")
                              << inertia_2D("body", planar_body(1.0, inertia));
  return c;
}
runtime_chain disc() { return planar(beta * ball_radius * ball_radius); }
/// A body of 1 kg in space, symmetric about z.
runtime_chain spatial(double across, double along) {
  runtime_chain c;
  c.gravity(vec3<>{0, 0, -g}) << base_3D("world") << free_joint_3D("pose", "world", "body")
                              << inertia_3D("body",
                                            rigid_body<>{1.0, vec3<>{}, sym3<>{across, 0.0, 0.0, across, 0.0, along}});
  return c;
}
struct outcome {
  vector x;
  event_report<vector> report;
};
outcome run(const model_type& model, const vector& q, const vector& v, double t, double tolerance = 1e-11) {
  prince_dormand87 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(q, v)),
                          {.absolute = tolerance, .relative = tolerance});
  auto report = solver.integrate(t, element_events(model));
  return {solver.state(), std::move(report)};
}

/// A plane that shakes along x: A sin(w t). A ball that rolls on it has the acceleration beta/(1 + beta) of the plane.
constexpr double shake = 0.05, pulse = 7, share = beta / (1 + beta), drift = 0.2;
double shaken_place(double t) { return drift * t + share * shake * std::sin(pulse * t); }
const auto place_law = [](const auto& t) {
  using std::sin;
  return along_x(shake * sin(pulse * t));
};
const auto rate_law = [](const auto& t) {
  using std::cos;
  return along_x(shake * pulse * cos(pulse * t));
};
const auto acceleration_law = [](const auto& t) {
  using std::sin;
  return along_x(-shake * pulse * pulse * sin(pulse * t));
};
const double start_speed = drift + share * shake * pulse, start_spin = (shake * pulse - start_speed) / ball_radius;

/// The largest error of the place between and at the ends of steps, up to 1 s.
template <class Solver, class Model>
double worst_place(Solver& solver, const Model& model) {
  double worst = 0;
  solver.integrate(1.0, element_events(model), every(0.013), [&worst](double t, const auto& x) {
    const double rolls = x[3] + ball_radius * x[5] - shake * pulse * std::cos(pulse * t);
    worst = std::max({worst, std::abs(x[0] - shaken_place(t)), std::abs(rolls)});
  });
  return worst;
}

namespace keys {
inline constexpr struct x_ final : coord_key<"x"> {
} x;
inline constexpr struct y_ final : coord_key<"y"> {
} y;
inline constexpr struct turn_ final : coord_key<"turn"> {
} turn;
inline constexpr struct world_ final : frame_2D_key<"world"> {
} world;
inline constexpr struct bx_ final : frame_2D_key<"bx"> {
} bx;
inline constexpr struct by_ final : frame_2D_key<"by"> {
} by;
inline constexpr struct body_ final : frame_2D_key<"body"> {
} body;
inline constexpr struct plane_ final : frame_2D_key<"plane"> {
} plane;
inline constexpr struct place_ final : vector_key<"place"> {
} place;
inline constexpr struct rate_ final : vector_key<"rate"> {
} rate;
inline constexpr struct acceleration_ final : vector_key<"acceleration"> {
} acceleration;
inline constexpr struct touch_ final : contact_key<"touch"> { } touch; }  // namespace keys

TEST_CASE("a ball rolls on a plane that shakes") {
  auto c = disc();
  c << law_signal(place_law, "time", "place") << law_signal(rate_law, "time", "rate")
    << law_signal(acceleration_law, "time", "acceleration")
    << position_control_2D("place", "rate", "acceleration", "world", "plane")
    << sphere_contact_2D("touch", "plane", "body", half_space{}, ball_radius, {.friction = 1});
  const model_type model(c);
  const vector x0 =
      settled(model, 0.0, model.make_x(numbers({0, ball_radius, 0}), numbers({start_speed, 0, start_spin})));
  prince_dormand87 high(std::cref(model), 0.0, x0, {.absolute = 1e-11, .relative = 1e-11});
  CHECK(worst_place(high, model) < 1e-9);
  // Of order 1: steps end at another time than that of their last evaluation
  euler low(std::cref(model), 0.0, x0, 2e-3);
  CHECK(worst_place(low, model) < 2e-3);
}

TEST_CASE("a static chain has surfaces that move with time") {
  using namespace keys;
  const auto c =
      chain(prismatic_joint_2D(x, world, bx, axis::x), prismatic_joint_2D(y, bx, by, axis::y),
            revolute_joint_2D(turn, by, body), inertia_2D(body, planar_body(1.0, beta * ball_radius * ball_radius)),
            law_signal(place_law, chain_time, place), law_signal(rate_law, chain_time, rate),
            law_signal(acceleration_law, chain_time, acceleration),
            position_control_2D(place, rate, acceleration, world, plane),
            sphere_contact_2D(touch, plane, body, half_space{}, ball_radius, {.friction = 1}))
          .gravity(along_y(-g));
  const manipulator_dynamics_model model(c);
  const auto x0 =
      settled(model, 0.0, model.make_x(std::array{0.0, ball_radius, 0.0}, std::array{start_speed, 0.0, start_spin}));
  prince_dormand87 solver(std::cref(model), 0.0, x0, {.absolute = 1e-11, .relative = 1e-11});
  CHECK(worst_place(solver, model) < 1e-9);
}

TEST_CASE("a body leaves a plate that shakes up and down") {
  // Where A w^2 sin(w t) = g; it hits the plate again where both heights are equal
  const double pulse_up = 20;
  auto c = planar(0.01);
  c << law_signal(
           [pulse_up](const auto& t) {
             using std::sin;
             return along_y(shake * sin(pulse_up * t));
           },
           "time", "place")
    << law_signal(
           [pulse_up](const auto& t) {
             using std::cos;
             return along_y(shake * pulse_up * cos(pulse_up * t));
           },
           "time", "rate")
    << law_signal(
           [pulse_up](const auto& t) {
             using std::sin;
             return along_y(-shake * pulse_up * pulse_up * sin(pulse_up * t));
           },
           "time", "acceleration")
    << position_control_2D("place", "rate", "acceleration", "world", "plate")
    << point_contact_2D("touch", "plate", "body", half_space{}, {.friction = 0.5});
  const model_type model(c);
  const auto end = run(model, numbers({0, 0, 0}), numbers({0, shake * pulse_up, 0}), 0.5);
  REQUIRE(end.report.count >= 2);
  const double leaves = std::asin(g / (shake * pulse_up * pulse_up)) / pulse_up;
  CHECK(end.report.events[0].what == "'touch': lifts");
  CHECK(end.report.events[0].time == within(leaves, 1e-11));
  const double hits = end.report.events[1].time, flight = hits - leaves;
  CHECK(end.report.events[1].what == "'touch': impact, sticks");
  CHECK(shake * std::sin(pulse_up * leaves) + shake * pulse_up * std::cos(pulse_up * leaves) * flight -
            g / 2 * flight * flight ==
        within(shake * std::sin(pulse_up * hits), 1e-11));
}

TEST_CASE("a ball rolls in a bowl") {
  // (1 + beta) theta'' = -g/(R - r) sin theta: a quarter of the period, K(sin(a/2)) sqrt((1 + beta)(R - r)/g)
  const double way = 1 - ball_radius, a = 0.5;
  auto c = disc();
  c << sphere_contact_2D("touch", "world", "body", bowl_surface(1.0), ball_radius, {.friction = 1});
  const model_type model(c);
  const double quarter = std::sqrt((1 + beta) * way / g) * std::comp_ellint_1(std::sin(a / 2));
  const vector q = numbers({way * std::sin(a), -way * std::cos(a), 0});
  const auto low = run(model, q, numbers({0, 0, 0}), quarter);
  const double speed = std::sqrt(2 * g * way * (1 - std::cos(a)) / (1 + beta));
  CHECK(low.x[0] == within(0.0, 1e-9));
  CHECK(low.x[3] == within(-speed, 1e-9));
  CHECK(low.x[5] == within(speed / ball_radius, 1e-8));
  CHECK(model.state_at(quarter, low.x).contact("touch").force.y == within(g + speed * speed / way, 1e-8));
  CHECK(low.report.count == 0);
}

TEST_CASE("a ball circles in a bowl, with spin about the normal") {
  // n to the contact at the angle a from below, N = w.n constant: (1 + beta) W^2 (R - r) cos a = g + beta r N W
  const double way = 1 - ball_radius, a = 0.8;
  auto c = spatial(beta * ball_radius * ball_radius, beta * ball_radius * ball_radius);
  c << sphere_contact_3D("touch", "world", "body", bowl_surface(1.0), ball_radius, {.friction = 3});
  const model_type model(c);
  const double spin = 20, k = (1 + beta) * way * std::cos(a), b = beta * ball_radius * spin;
  const double rate = (b + std::sqrt(b * b + 4 * k * g)) / (2 * k);
  const Eigen::Vector3d n(std::sin(a), 0, -std::cos(a)), v(0, rate * way * std::sin(a), 0),
      w = spin * n - n.cross(v) / ball_radius;
  const auto end = run(model, numbers({way * n[0], 0, way * n[2], 1, 0, 0, 0}),
                       numbers({v[0], v[1], v[2], w[0], w[1], w[2]}), pi / rate);
  CHECK(end.x[0] == within(-way * n[0], 1e-9));
  CHECK(end.x[1] == within(0.0, 1e-9));
  CHECK(end.x[2] == within(way * n[2], 1e-9));
}

TEST_CASE("a ball on a turntable moves on a circle, at beta/(1 + beta) of its rate") {
  const double rate = 3;
  auto c = spatial(beta * ball_radius * ball_radius, beta * ball_radius * ball_radius);
  c << law_signal([rate](const auto& t) { return along_z(rate * t); }, "time", "turn")
    << law_signal([rate](const auto& t) { return along_z(rate + 0 * t); }, "time", "rate")
    << law_signal([](const auto& t) { return along_z(0 * t); }, "time", "none")
    << rotation_control_3D("turn", "rate", "none", "world", "table")
    << sphere_contact_3D("touch", "table", "body", half_space{}, ball_radius, {.friction = 2});
  const model_type model(c);
  const Eigen::Vector3d p(0.3, -0.2, ball_radius), v(0.5, 0.1, 0), z(0, 0, 1);
  const Eigen::Vector3d w = z.cross(v - rate * z.cross(p)) / ball_radius + 4 * z;
  const double own = share * rate, t = 1.7;
  const auto end =
      run(model, numbers({p[0], p[1], p[2], 1, 0, 0, 0}), numbers({v[0], v[1], v[2], w[0], w[1], w[2]}), t);
  const Eigen::Vector3d centre = p + z.cross(v) / own, at = centre + Eigen::AngleAxisd(own * t, z) * (p - centre);
  CHECK((end.x.head(3) - at).norm() < 1e-9);
}

TEST_CASE("a ball leaves a cylinder, or slips before") {
  const double reach = 1 + ball_radius, start = 0.1;
  const vector q = numbers({reach * std::sin(start), reach * std::cos(start), 0}), rest = numbers({0, 0, 0});
  const auto angle = [](const vector& x) { return std::atan2(x[0], x[1]); };
  const auto first = [&](double friction) {
    auto c = disc();
    c << sphere_contact_2D("touch", "world", "body", ball_surface(1.0), ball_radius, {.friction = friction});
    const model_type model(c);
    const auto end = run(model, q, rest, 3.0);
    REQUIRE(end.report.count >= 1);
    return end.report.events[0];
  };
  const auto leaves = first(0);
  CHECK(leaves.what == "'touch': lifts");
  CHECK(std::cos(angle(leaves.before)) == within(2 * std::cos(start) / 3, 1e-10));
  // F = beta/(1 + beta) m g sin, N = m g (cos - 2 (cos_0 - cos)/(1 + beta))
  const double mu = 0.6;
  const auto slips = first(mu);
  CHECK(slips.what == "'touch': slides");
  const double at = angle(slips.before);
  CHECK(share * std::sin(at) == within(mu * (std::cos(at) - 2 * (std::cos(start) - std::cos(at)) / (1 + beta)), 1e-10));
}

TEST_CASE("a block rocks on its corners") {
  // Housner: half sides b, h; the rate before is that of a pendulum, after it 1 - 3/2 sin^2 alpha of that
  const double b = 0.1, h = 0.4, alpha = std::atan2(b, h), reach = std::hypot(b, h), own = reach * reach / 3,
               tilt = alpha / 2;
  auto c = planar(own);
  for (const double side : {-1.0, 1.0}) {
    const std::string name = side < 0 ? "left" : "right";
    c << rigid_link_2D("body", name + " foot", vec2<>{side * b, -h})
      << point_contact_2D(name, "world", name + " foot", half_space{}, {.friction = 2});
  }
  const model_type model(c);
  const vector q = numbers({-b * std::cos(tilt) + h * std::sin(tilt), b * std::sin(tilt) + h * std::cos(tilt), -tilt});
  const auto end = run(model, q, numbers({0, 0, 0}), 30.0);
  const auto& hit = end.report.events[0];
  const double rate = std::sqrt(2 * g * reach * (std::cos(alpha - tilt) - std::cos(alpha)) / (own + reach * reach));
  CHECK(hit.before[5] == within(rate, 1e-10));
  CHECK(hit.after[5] == within((1 - 1.5 * std::pow(std::sin(alpha), 2)) * rate, 1e-10));
  CHECK(hit.what == "'left': impact, sticks; 'right': lifts");
  CHECK(end.x[2] == within(0.0, 1e-12));  // after ever shorter swings
  CHECK(end.x[5] == within(0.0, 1e-12));
}

TEST_CASE("a disc rolls in a circle") {
  // Axis at the angle a from the vertical, precession W, spin w about the axis:
  // (C + m r^2) w W sin a - A W^2 sin a cos a + m g r cos a = 0
  const double r = 0.3, across = r * r / 4, along = r * r / 2, a = 1.2, rate = 2;
  auto c = spatial(across, along);
  c << disc_contact_3D("rim", "world", "body", half_space{}, axis::z, r, {.friction = 5});
  const model_type model(c);
  const double s = std::sin(a), k = std::cos(a),
               spin = (across * rate * rate * s * k - g * r * k) / ((along + r * r) * rate * s);
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, k, -s, 0, s, k;  // the tangent of the rim, up the disc, its axis
  const Eigen::Quaterniond at(turn);
  const Eigen::Vector3d w(0, rate * s, spin), v = r * w.cross(Eigen::Vector3d(0, 1, 0));  // in axes of the disc
  const auto end = run(model, numbers({0, 0, r * s, at.w(), at.x(), at.y(), at.z()}),
                       numbers({v[0], v[1], v[2], w[0], w[1], w[2]}), 2 * pi / rate);
  CHECK(end.x.head(2).norm() < 1e-9);
  CHECK(end.x[2] == within(r * s, 1e-10));
}

TEST_CASE("bodies of very different masses rest on each other") {
  for (const double ratio : {1e-12, 1e-6, 1e6}) {
    const double below = ratio < 1 ? 1 : 1 / ratio, above = ratio < 1 ? ratio : 1;
    runtime_chain c;
    c.gravity(vec3<>{0, -g, 0}) << base_2D("world") << prismatic_joint_2D("y1", "world", "A", axis::y)
                                << inertia_2D("A", point_mass(below)) << prismatic_joint_2D("y2", "world", "B", axis::y)
                                << inertia_2D("B", point_mass(above))
                                << sphere_contact_2D("floor", "world", "A", half_space{}, 0.2, {})
                                << sphere_contact_2D("between", "A", "B", ball_surface(0.2), 0.1, {});
    auto s = c.make_state();
    const auto& r = contact_dynamics(c, s, numbers({0.2, 0.5}), numbers({0, 0}), numbers({0, 0}));
    const double tolerance = 1e-14 * std::max(1.0, ratio);  // W of a light body below has the condition of the ratio
    CHECK(r.force("floor").y == within((below + above) * g, tolerance * (below + above) * g));
    CHECK(r.force("between").y == within(above * g, tolerance * above * g));
    CHECK(r.a.cwiseAbs().maxCoeff() < 10 * tolerance * g);
  }
}

TEST_CASE("a pendulum on a rod hits a wall") {
  runtime_chain c;
  c.gravity(vec3<>{0, -g, 0}) << base_2D("world") << prismatic_joint_2D("x", "world", "a", axis::x)
                              << prismatic_joint_2D("y", "a", "p", axis::y) << inertia_2D("p", point_mass(1.5))
                              << distance_2D("rod", "world", "p", 1.0) << rigid_link_2D("world", "wall", along_x(-0.3))
                              << point_contact_2D("touch", "wall", "p", half_space(vec3{1.0, 0.0, 0.0}),
                                                  {.restitution = 0.6});
  const model_type model(c);
  const double start = 0.5;
  const auto end = run(model, numbers({std::sin(start), -std::cos(start)}), numbers({0, 0}), 3.0);
  const double speed = std::sqrt(2 * g * (std::sqrt(1 - 0.09) - std::cos(start)));
  REQUIRE(end.report.count >= 2);
  CHECK(end.report.events[0].before.segment(2, 2).norm() == within(speed, 1e-9));
  CHECK(end.report.events[0].after.segment(2, 2).norm() == within(0.6 * speed, 1e-9));
  CHECK(end.x.head(2).norm() == within(1.0, 1e-14));
}

}  // namespace closed_form_scenes_test
