#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/relative_motion.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

#include "catch.hpp"
#include "closed_loops/tangle.hpp"
#include "contact/legged.hpp"
#include "digits50.hpp"
#include "random.hpp"

namespace contact_derivatives_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::legged;
using kte::test::loops::vector;

using geometry = core::contact_geometry<kind::frame_3D, contact_surface>;

template <class S>
using three = Eigen::Matrix<S, 3, 1>;
template <class S>
three<S> column(const vec3<S>& v) {
  return {v.x, v.y, v.z};
}

enum class law { open, sticks, slides, begins };

/// Equations of motion and of contacts in given modes, by the whole matrix and Newton's method with differences.
template <class S>
struct reference {
  using numbers = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  struct at_contact {
    matrix j;
    three<S> n, drift, d;
    S apart{}, friction{};
    law mode{};
  };
  matrix mass;
  numbers bias;
  std::array<at_contact, 2> contacts;

  template <class Tree>
  reference(const scene& of, const Tree& tree, const numbers& q, const numbers& v, std::array<law, 2> modes) {
    mass = mass_matrix(tree, q), bias = nonlinear_effects(tree, q, v);
    const auto motions = [&](const numbers& rates, const numbers& a) {
      return std::array{detail::as_closing_motion<S>(relative_motion(tree, q, rates, a, body, floor_of_carriage)),
                        detail::as_closing_motion<S>(relative_motion(tree, q, rates, a, foot, hill))};
    };
    const std::array<geometry, 2> shapes{geometry{contact_surface{{0, 0, 1}, 0}, radius, heel},
                                         geometry{contact_surface{{}, of.size}, radius, {}}};
    const numbers none = numbers::Zero(scene_dofs);
    const auto still = motions(v, none);
    for (std::size_t i = 0; i < 2; ++i) {
      auto& c = contacts[i];
      c.n = column(shapes[i].normal(still[i])), c.drift = column(shapes[i].slip_rate(still[i]));
      c.apart = shapes[i].gap_ddot(still[i]);
      c.friction = S(i == 0 ? of.friction_of_floor : of.friction_of_hill), c.mode = modes[i];
      const three<S> u = column(shapes[i].slip(still[i])), t = u - c.n.dot(u) * c.n;
      if (c.mode == law::slides) c.d = t / S(sqrt(S(t.dot(t))));
      c.j.resize(3, scene_dofs);
      for (int k = 0; k < scene_dofs; ++k)
        c.j.col(k) = column(shapes[i].slip(motions(numbers::Unit(scene_dofs, k), none)[i]));
    }
  }
  /// Residuals for accelerations and forces.
  numbers residual(const numbers& z, const numbers& tau) const {
    numbers r(scene_dofs + 6);
    r.head(scene_dofs) = mass * z.head(scene_dofs) + bias - tau;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& c = contacts[i];
      const auto row = static_cast<Eigen::Index>(scene_dofs + 3 * i);
      const three<S> f = z.template segment<3>(row), j = c.j * z.head(scene_dofs);
      r.head(scene_dofs) -= c.j.transpose() * f;
      const three<S> rate = j + c.drift, along = rate - c.n.dot(rate) * c.n, across = f - c.n.dot(f) * c.n;
      const S apart = c.apart + c.n.dot(j), load = c.friction * c.n.dot(f);
      three<S> law_of = f;
      if (c.mode == law::sticks) law_of = along + apart * c.n;
      if (c.mode == law::slides) law_of = across + load * c.d + apart * c.n;
      if (c.mode == law::begins) law_of = across + load / S(sqrt(S(along.dot(along)))) * along + apart * c.n;
      r.template segment<3>(row) = law_of;
    }
    return r;
  }
  numbers solve(numbers z, const numbers& tau) const {
    const S h(1e-20);
    for (int step = 0; step < 5; ++step) {
      const numbers r = residual(z, tau);
      matrix by(scene_dofs + 6, scene_dofs + 6);
      for (int k = 0; k < scene_dofs + 6; ++k)
        by.col(k) = (residual(z + h * numbers::Unit(scene_dofs + 6, k), tau) - r) / h;
      z -= by.partialPivLu().solve(r);
    }
    return z;
  }
};
using exact = reference<digits50>;
using big = exact::numbers;

Eigen::MatrixXd as_doubles(const exact::matrix& m) {
  return m.unaryExpr([](const digits50& x) { return static_cast<double>(x); });
}
double off(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

/// A state where both contacts touch with the given modes, found at random.
struct found_state {
  scene at;
  vector q, v, tau;
};
found_state find_state(const std::array<law, 2>& modes, random_numbers& draw) {
  const auto some = [&](int n) { return vector(vector::NullaryExpr(n, [&] { return draw(); })); };
  for (int i = 0; i < 500; ++i) {
    found_state x;
    const auto flat = x.at.tree();
    x.q = integrate(flat, neutral_configuration(flat), vector(0.4 * some(scene_dofs)), 1.0);
    const auto place = relative_pose(flat, x.q, body, floor_of_carriage);
    x.at.height = (place.position + place.rotation * heel).z - radius;
    const auto foot_at = relative_pose(flat, x.q, foot, world);
    const vec3<> away = foot_at.position - top_of_hill;  // |away + size e_z| = size + radius
    x.at.size = (dot(away, away) - radius * radius) / (2 * (radius - away.z));
    if (!(x.at.size > 0.1)) continue;
    const auto friction = [](law mode) { return mode == law::begins ? 0.05 : mode == law::slides ? 0.3 : 3.0; };
    x.at.friction_of_floor = friction(modes[0]), x.at.friction_of_hill = friction(modes[1]);
    const reference<double> r(x.at, x.at.tree(), x.q, vector::Zero(scene_dofs), modes);
    Eigen::MatrixXd rows(6, scene_dofs);
    for (int k = 0; k < 2; ++k) {
      const auto& c = r.contacts[static_cast<std::size_t>(k)];
      const bool slides = modes[static_cast<std::size_t>(k)] == law::slides;
      rows.middleRows(3 * k, 3) = slides ? Eigen::MatrixXd(c.n * c.n.transpose() * c.j) : Eigen::MatrixXd(c.j);
    }
    x.v = some(scene_dofs);
    x.v -= rows.completeOrthogonalDecomposition().solve(rows * x.v);
    x.tau = 3 * some(scene_dofs);
    runtime_chain c;
    c << x.at.touching();
    auto s = c.make_state();
    try {
      const auto& y = contact_dynamics(c, s, x.q, x.v, x.tau);
      const auto has = [&](const char* name, law mode) {
        return mode_of(y.contact(name)) == (mode == law::open     ? contact_mode::open
                                            : mode == law::sticks ? contact_mode::sticks
                                                                  : contact_mode::slides);
      };
      if (has("on floor", modes[0]) && has("on hill", modes[1])) return x;
    } catch (const bad_argument&) {
    }
  }
  FAIL("no such state");
  return {};
}

void check_derivatives(const std::array<law, 2>& modes, random_numbers& draw) {
  const auto x = find_state(modes, draw);
  const auto tree = x.at.tree();
  runtime_chain c;
  c << x.at.touching();
  auto s = c.make_state();
  const auto r = contact_dynamics_derivatives(c, s, x.q, x.v, x.tau);
  const big q = x.q.cast<digits50>(), v = x.v.cast<digits50>(), tau = x.tau.cast<digits50>();
  big start(scene_dofs + 6);
  const auto force = [&r](const char* name) { return column(r.contact(name).at.force); };
  start << r.a.cast<digits50>(), force("on floor").cast<digits50>(), force("on hill").cast<digits50>();
  const auto solution = [&](const big& of_q, const big& of_v, const big& of_tau) {
    return exact(x.at, tree, of_q, of_v, modes).solve(start, of_tau);
  };
  CHECK(off(vector(start.unaryExpr([](const digits50& y) { return static_cast<double>(y); })),
            as_doubles(solution(q, v, tau))) <= 1e-12);
  const digits50 h(1e-15);
  exact::matrix by_q(scene_dofs + 6, scene_dofs), by_v(scene_dofs + 6, scene_dofs), by_tau(scene_dofs + 6, scene_dofs);
  for (int k = 0; k < scene_dofs; ++k) {
    const big step = h * big::Unit(scene_dofs, k);
    const auto moved = [&](const big& d) { return big(integrate(tree, q, d, digits50(1))); };
    by_q.col(k) = (solution(moved(step), v, tau) - solution(moved(-step), v, tau)) / (2 * h);
    by_v.col(k) = (solution(q, v + step, tau) - solution(q, v - step, tau)) / (2 * h);
    by_tau.col(k) = (solution(q, v, tau + step) - solution(q, v, tau - step)) / (2 * h);
  }
  // The direction in which sliding begins is that of a friction force, which is known to 1e-12 of the forces.
  const bool begins = modes[0] == law::begins || modes[1] == law::begins;
  const double most = begins ? 1e-11 : 1e-12;
  const auto compare = [&](const exact::matrix& by, const Eigen::MatrixXd& a, const Eigen::MatrixXd& f,
                           const Eigen::MatrixXd& g) {
    const Eigen::MatrixXd expected = as_doubles(by);
    CHECK(off(a, expected.topRows(scene_dofs)) <= most);
    CHECK(off(f, expected.middleRows(scene_dofs, 3)) <= most);
    CHECK(off(g, expected.bottomRows(3)) <= most);
  };
  const auto &f = r.contact("on floor"), &g = r.contact("on hill");
  compare(by_q, r.by_q, f.force_by_q, g.force_by_q);
  compare(by_v, r.by_v, f.force_by_v, g.force_by_v);
  compare(by_tau, r.by_tau, f.force_by_tau, g.force_by_tau);
  const auto fixed = contact_dynamics_derivatives(x.at.touching(), x.q, x.v, x.tau);
  CHECK(fixed.by_q == r.by_q);
  CHECK(fixed.contact("on hill").force_by_v == g.force_by_v);
}

TEST_CASE("derivatives of contact dynamics agree with differences of 50 digits in all modes", "[long]") {
  random_numbers draw(3);
  const std::array<law, 2> all[]{{law::sticks, law::sticks}, {law::slides, law::sticks}, {law::sticks, law::slides},
                                 {law::slides, law::slides}, {law::begins, law::sticks}, {law::open, law::begins},
                                 {law::open, law::slides}};
  for (const auto& modes : all) {
    INFO("modes " << static_cast<int>(modes[0]) << ", " << static_cast<int>(modes[1]));
    check_derivatives(modes, draw);
  }
}

}  // namespace contact_derivatives_test
