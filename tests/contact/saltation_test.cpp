#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/relative_motion.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/kte.hpp>
#include <kte/models/transition_matrix.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <functional>

#include "catch.hpp"
#include "contact/legged.hpp"
#include "contact/walkers.hpp"
#include "digits50.hpp"
#include "random.hpp"

namespace saltation_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::legged;

using geometry = core::contact_geometry<kind::frame_3D, contact_surface>;
using big = Eigen::Matrix<digits50, Eigen::Dynamic, 1>;
using big_matrix = Eigen::Matrix<digits50, Eigen::Dynamic, Eigen::Dynamic>;
using big_three = Eigen::Matrix<digits50, 3, 1>;

constexpr double g = 9.81;
const kte::tolerances<double> tight{.absolute = 1e-13, .relative = 1e-13};

Eigen::MatrixXd as_doubles(const big_matrix& m) {
  return m.unaryExpr([](const digits50& x) { return static_cast<double>(x); });
}
double off(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}
/// The derivative of f, by central differences of 50 digits.
big_matrix differences(const std::function<big(const big&)>& f, const big& x) {
  const digits50 h(1e-18);
  big_matrix by(f(x).size(), x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const big step = h * big::Unit(x.size(), k);
    by.col(k) = (f(x + step) - f(x - step)) / (2 * h);
  }
  return by;
}

enum class law { open, sticks, slides };

/// The equations of an impact in given modes: the whole matrix, and Newton's method with differences.
struct impact_reference {
  const scene& of;
  std::array<law, 2> modes;
  std::array<double, 2> restitution;

  big residual(const big& q, const big& v, const big& z) const {
    const auto tree = of.tree();
    const big none = big::Zero(scene_dofs), after = z.head(scene_dofs);
    const auto motions = [&](const big& rates) {
      return std::array{
          detail::as_closing_motion<digits50>(relative_motion(tree, q, rates, none, body, floor_of_carriage)),
          detail::as_closing_motion<digits50>(relative_motion(tree, q, rates, none, foot, hill))};
    };
    const std::array<geometry, 2> shapes{geometry{contact_surface{{0, 0, 1}, 0}, radius, heel},
                                         geometry{contact_surface{{}, of.size}, radius, {}}};
    const auto slip = [&](std::size_t i, const big& rates) {
      const auto u = shapes[i].slip(motions(rates)[i]);
      return big_three(u.x, u.y, u.z);
    };
    big r(scene_dofs + 6);
    r.head(scene_dofs) = mass_matrix(tree, q) * (after - v);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto row = static_cast<Eigen::Index>(scene_dofs + 3 * i);
      const big_three p = z.segment<3>(row), u = slip(i, after), before = slip(i, v);
      const auto at = shapes[i].normal(motions(none)[i]);
      const big_three n(at.x, at.y, at.z);
      for (int k = 0; k < scene_dofs; ++k) r[k] -= p.dot(slip(i, big::Unit(scene_dofs, k)));
      const big_three along = u - n.dot(u) * n, across = p - n.dot(p) * n;
      const digits50 apart = n.dot(u) + digits50(restitution[i]) * n.dot(before);
      const digits50 friction(i == 0 ? of.friction_of_floor : of.friction_of_hill);
      const big_three slides = sqrt(along.dot(along)) * across + friction * n.dot(p) * along + apart * n;
      r.segment<3>(row) = modes[i] == law::open ? p : modes[i] == law::sticks ? big_three(along + apart * n) : slides;
    }
    return r;
  }
  /// The derivatives of the velocities after, by q, along the numbers of v, and by v, from a start of Newton's method.
  std::array<Eigen::MatrixXd, 2> derivatives(const big& q, const big& v, big z) const {
    const auto by_z = [&] { return differences([&](const big& y) { return residual(q, v, y); }, z); };
    for (int step = 0; step < 2; ++step) z -= by_z().partialPivLu().solve(residual(q, v, z));
    const auto tree = of.tree();
    const auto whole = by_z().partialPivLu();
    const auto of_q = differences([&](const big& d) { return residual(integrate(tree, q, d, digits50(1)), v, z); },
                                  big::Zero(scene_dofs));
    const auto of_v = differences([&](const big& x) { return residual(q, x, z); }, v);
    return {as_doubles(-whole.solve(of_q).topRows(scene_dofs)), as_doubles(-whole.solve(of_v).topRows(scene_dofs))};
  }
};

TEST_CASE("derivatives of impacts agree with differences of 50 digits in all modes", "[long]") {
  random_numbers draw(7);
  std::array<std::array<int, 3>, 3> tried{};
  for (int trial = 0, checked = 0; checked < 6 && trial < 400; ++trial) {
    scene at;
    const auto some = [&] { return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(scene_dofs, [&] { return draw(); })); };
    const auto flat = at.tree();
    const Eigen::VectorXd q = integrate(flat, neutral_configuration(flat), Eigen::VectorXd(0.4 * some()), 1.0);
    const auto place = relative_pose(flat, q, body, floor_of_carriage);
    at.height = (place.position + place.rotation * heel).z - radius;
    const auto foot_at = relative_pose(flat, q, foot, world);
    const vec3<> away = foot_at.position - top_of_hill;
    at.size = (dot(away, away) - radius * radius) / (2 * (radius - away.z));
    if (!(at.size > 0.1)) continue;
    at.friction_of_floor = trial % 2 == 0 ? 2.0 : 0.1, at.friction_of_hill = trial % 3 == 0 ? 2.0 : 0.2;
    const Eigen::VectorXd v = some();
    const std::array<double, 2> e{0.0, 0.0};
    runtime_chain c;
    c << at.touching();
    auto s = c.make_state();
    const auto found = impact(c, s, q, v);
    if (found.restitution != 1) continue;
    std::array<law, 2> modes{};
    big start(scene_dofs + 6);
    start.head(scene_dofs) = found.v.cast<digits50>();
    const auto j = contact_jacobian(c, s, q, at_contacts("on floor", "on hill"));
    const Eigen::VectorXd u = j * found.v;
    for (std::size_t i = 0; i < 2; ++i) {
      const vec3<> p = found.impulse(i == 0 ? "on floor" : "on hill");
      start.segment<3>(static_cast<Eigen::Index>(scene_dofs + 3 * i)) << digits50(p.x), digits50(p.y), digits50(p.z);
      const bool moves = u.segment<3>(static_cast<Eigen::Index>(3 * i)).norm() > 1e-6;
      modes[i] = dot(p, p) == 0 ? law::open : moves ? law::slides : law::sticks;
    }
    int& times = tried[static_cast<std::size_t>(modes[0])][static_cast<std::size_t>(modes[1])];
    if ((modes[0] == law::open && modes[1] == law::open) || times > 0) continue;
    ++times, ++checked;
    INFO("modes " << static_cast<int>(modes[0]) << ", " << static_cast<int>(modes[1]));
    const auto r = impact_derivatives(c, s, q, v);
    const auto [by_q, by_v] = impact_reference{at, modes, e}.derivatives(q.cast<digits50>(), v.cast<digits50>(), start);
    CHECK(off(r.by_q, by_q) < 1e-10);
    CHECK(off(r.by_v, by_v) < 1e-10);
    CHECK(impact_derivatives(at.touching(), q, v).by_q == r.by_q);
  }
  int different = 0;
  for (const auto& row : tried)
    different += static_cast<int>(std::count_if(row.begin(), row.end(), [](int n) { return n > 0; }));
  CHECK(different == 6);
}

/// A body of 1 kg in the plane that moves by x, y and an angle: frame "body".
runtime_chain planar(double inertia, const vec3<>& gravity = {0, -g, 0}) {
  runtime_chain c;
  c.gravity(gravity) << base_2D("world") << prismatic_joint_2D("x", "world", "a", axis::x)
                     << prismatic_joint_2D("y", "a", "b", axis::y) << revolute_joint_2D("angle", "b", "body")
                     << inertia_2D("body", planar_body(1.0, inertia));
  return c;
}
/// Phi of a motion with events from q and v to t.
template <class Model>
Eigen::MatrixXd phi_of(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                       long long events) {
  transition_matrix phi(model);
  prince_dormand87 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(q, v)), tight);
  const auto report = solver.integrate(t, element_events(model), phi);
  CHECK(report.count == events);
  return phi.matrix();
}
big numbers_of(std::initializer_list<double> x) {
  big v(static_cast<Eigen::Index>(x.size()));
  std::copy(x.begin(), x.end(), v.begin());
  return v;
}

TEST_CASE("motions with impacts, stops and turns have the derivatives of their closed forms") {
  {  // A ball that spins bounces twice; the first impact slides, the second sticks
    const double e = 0.6, mu = 0.2, inertia = 0.004, radius_of_ball = 0.1, end = 1.1;
    auto c = planar(inertia);
    c << sphere_contact_2D("rim", "world", "body", half_space{}, radius_of_ball, {.friction = mu, .restitution = e});
    const auto exact = [&](const big& x0) {
      big x = x0;
      digits50 rest(end);
      const digits50 acceleration(g), r(radius_of_ball);
      for (int bounce = 0; bounce < 2; ++bounce) {
        const digits50 height = x[1] - r, t = (x[4] + sqrt(x[4] * x[4] + 2 * acceleration * height)) / acceleration;
        x[0] += t * x[3], x[2] += t * x[5], x[1] = r, x[4] -= acceleration * t, rest -= t;
        const digits50 normal = -(1 + digits50(e)) * x[4], slip = x[3] + r * x[5];
        const digits50 sticking = -slip / (1 + r * r / digits50(inertia));
        const digits50 limit = digits50(mu) * normal, push = sticking > limit    ? limit
                                                             : sticking < -limit ? digits50(-limit)
                                                                                 : sticking;
        x[4] *= -digits50(e), x[3] += push, x[5] += push * r / digits50(inertia);
      }
      x[0] += rest * x[3], x[2] += rest * x[5], x[1] += rest * x[4] - acceleration * rest * rest / 2;
      x[4] -= acceleration * rest;
      return x;
    };
    const manipulator_dynamics_model model(c);
    const auto phi = phi_of(model, Eigen::Vector3d(0, 0.9, 0.2), Eigen::Vector3d(3, 0.3, 2), end, 2);
    CHECK(off(phi, as_doubles(differences(exact, numbers_of({0, 0.9, 0.2, 3, 0.3, 2})))) < 1e-11);
  }
  {  // A ball slips, then rolls
    const double mu = 0.2;
    auto c = planar(0.004);
    c << sphere_contact_2D("rim", "world", "body", half_space{}, 0.1, {.friction = mu});
    const auto exact = [&](const big& x0) {  // x, angle, and their rates
      const digits50 slow = digits50(mu) * digits50(g), spin = slow * digits50(0.1) / digits50(0.004);
      const digits50 t = (x0[2] + digits50(0.1) * x0[3]) / (slow + digits50(0.1) * spin), rest = 1 - t;
      big x(4);
      x[2] = x0[2] - slow * t, x[3] = x0[3] - spin * t;
      x[0] = x0[0] + (x0[2] - slow * t / 2) * t + x[2] * rest, x[1] = x0[1] + (x0[3] - spin * t / 2) * t + x[3] * rest;
      return x;
    };
    const manipulator_dynamics_model model(c);
    const auto phi = phi_of(model, Eigen::Vector3d(0, 0.1, 0), Eigen::Vector3d(1, 0, 0.5), 1.0, 1);
    const std::array<int, 4> rows{0, 2, 3, 5};
    const Eigen::MatrixXd part = phi(rows, rows);
    CHECK(off(part, as_doubles(differences(exact, numbers_of({0, 0, 1, 0.5})))) < 1e-12);
  }
  for (const double mu : {0.2, 0.4}) {  // A box on two corners slides up a slope and back, or rests
    auto c = planar(0.01, {-g * std::sin(0.3), -g * std::cos(0.3), 0});
    for (const auto& [name, x] : {std::pair{"left", -0.1}, {"right", 0.1}})
      c << rigid_link_2D("body", std::string(name) + " place", vec2{x, -0.05})
        << point_contact_2D(name, "world", std::string(name) + " place", half_space{}, {.friction = mu});
    const double up = g * (std::sin(0.3) + mu * std::cos(0.3)), down = g * (std::sin(0.3) - mu * std::cos(0.3));
    const double halt = 2 / up, rest = 2 - halt;
    const manipulator_dynamics_model model(c);
    const auto phi = phi_of(model, Eigen::Vector3d(0, 0.05, 0), Eigen::Vector3d(2, 0, 0), 2.0, 1);
    CHECK(phi(0, 0) == within(1.0, 1e-12));
    CHECK(phi(0, 3) == within(halt + (mu < 0.3 ? down / up * rest : 0.0), 1e-11));
    CHECK(phi(3, 3) == within(mu < 0.3 ? down / up : 0.0, 1e-11));
  }
}

TEST_CASE("a model in the middle of a step computes states of other modes") {
  auto c = planar(0.01, {-g * std::sin(0.3), -g * std::cos(0.3), 0});
  c << rigid_link_2D("body", "place", vec2{0.0, -0.05})
    << point_contact_2D("foot", "world", "place", half_space{}, {.friction = 0.4});
  const manipulator_dynamics_model model(c);
  prince_dormand87 solver(std::cref(model), 0.0, model.make_x(Eigen::Vector3d(0, 0.1, 0), Eigen::Vector3d(2, 0, 0)),
                          tight);
  const auto report = solver.integrate(0.8, element_events(model));
  REQUIRE(report.count >= 2);
  for (const auto& e : report.events)
    for (const auto& x : {e.before, e.after}) {
      const manipulator_dynamics_model fresh(c);
      CHECK((model(e.time, x) - fresh(e.time, x)).cwiseAbs().maxCoeff() < 1e-13);
    }
}

TEST_CASE("a ball that rolls and spins in space has the derivatives of differences") {
  runtime_chain c;
  c.gravity(vec3<>{0.3, 0.1, -g}) << base_3D("world") << free_joint_3D("pose", "world", "ball")
                                  << inertia_3D("ball", rigid_body<>{1.0, vec3<>{0.01, 0, 0.02},
                                                                     sym3<>{0.004, 0.0, 0.0, 0.005, 0.0, 0.006}})
                                  << sphere_contact_3D("floor", "world", "ball", half_space{}, 0.1, {.friction = 2.0});
  const manipulator_dynamics_model model(c);
  const Eigen::VectorXd q = (Eigen::VectorXd(7) << 0, 0, 0.1, 1, 0, 0, 0).finished();
  const Eigen::VectorXd v = (Eigen::VectorXd(6) << 0.3, -0.2, 0, 2, 3, 1).finished();
  const auto x0 = settled(model, 0.0, model.make_x(q, v));
  const auto end_of = [&](const Eigen::VectorXd& start) {
    prince_dormand87 solver(std::cref(model), 0.0, start, tight);
    solver.integrate(0.5, element_events(model));
    return Eigen::VectorXd(solver.state());
  };
  transition_matrix phi(model);
  prince_dormand87 solver(std::cref(model), 0.0, x0, tight);
  CHECK(solver.integrate(0.5, element_events(model), phi).count == 0);
  const double h = 1e-4;
  for (int k = 0; k < 12; ++k) {
    const auto moved = [&](double by) {
      Eigen::VectorXd step = by * Eigen::VectorXd::Unit(model.rates(), k), to = x0;
      model.displace(x0, step, to), model.settle(x0, step, to);
      return end_of(to);
    };
    const Eigen::VectorXd up = moved(h), down = moved(-h);
    const Eigen::VectorXd along = difference(c, Eigen::VectorXd(down.head(7)), Eigen::VectorXd(up.head(7))) / (2 * h);
    CHECK((phi.matrix().col(k).head(6) - along).norm() < 1e-6);
    CHECK((phi.matrix().col(k).tail(6) - (up.segment(7, 6) - down.segment(7, 6)) / (2 * h)).norm() < 1e-6);
  }
}

/// The moduli and angles of multipliers of a walker over one step: the legs change places.
template <class Model>
std::vector<std::complex<double>> multipliers(const Model& model, const walkers::start_of_step& start, double period) {
  prince_dormand87 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(start.q, start.v)), tight);
  solver.integrate(0.1, element_events(model));
  transition_matrix phi(model);
  const auto report = solver.integrate(0.1 + period, element_events(model), phi);
  CHECK(report.count == 2);
  Eigen::MatrixXd legs = Eigen::MatrixXd::Zero(8, 8);
  for (const int k : {0, 4}) legs(k, k) = legs(k + 1, k + 1) = legs(k + 2, k + 3) = legs(k + 3, k + 2) = 1;
  const Eigen::VectorXcd all = (legs * phi.matrix()).eigenvalues();
  std::vector<std::complex<double>> some(all.begin(), all.end());
  std::erase_if(some, [](const auto& x) { return std::abs(x) < 1e-4 || std::abs(x - 1.0) < 1e-4; });
  std::sort(some.begin(), some.end(),
            [](const auto& a, const auto& b) { return std::pair(a.real(), a.imag()) < std::pair(b.real(), b.imag()); });
  return some;
}

TEST_CASE("the cycle of a compass walker has its known multipliers") {
  const auto c = walkers::chain_of(walkers::compass);
  const auto found = multipliers(manipulator_dynamics_model(c), walkers::compass_cycle, 0.73434639115872);
  REQUIRE(found.size() == 3);
  // By differences of the equations of motion in two coordinates
  CHECK(found[0].real() == within(-0.1997261268, 2e-9));
  CHECK(found[0].imag() == within(-0.5444760615, 2e-9));
  CHECK(found[1] == std::conj(found[0]));
  CHECK(found[2].real() == within(0.1315726241, 2e-9));
}

TEST_CASE("saltation matrices are refused where they are not defined") {
  auto c = planar(0.01);
  for (const auto& [name, x] : {std::pair{"left", -0.1}, {"right", 0.1}})
    c << rigid_link_2D("body", std::string(name) + " place", vec2{x, -0.05})
      << point_contact_2D(name, "world", std::string(name) + " place", half_space{}, {});
  const manipulator_dynamics_model model(c);
  prince_dormand87 solver(std::cref(model), 0.0, model.make_x(Eigen::Vector3d(0, 0.15, 0), Eigen::Vector3d::Zero()),
                          tight);
  const auto report = solver.integrate(1.0, element_events(model));
  CHECK_THROWS_WITH(saltation_matrix(model, report.events.front()),
                    Catch::Matchers::Contains("contacts 'left' and 'right' change at one time"));
}

}  // namespace saltation_test
