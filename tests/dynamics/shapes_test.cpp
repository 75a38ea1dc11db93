#include <kte/dynamics.hpp>
#include <kte/elements/differential.hpp>
#include <kte/elements/dry_revolute_joint.hpp>
#include <kte/elements/law_follower.hpp>
#include <kte/elements/law_signal.hpp>
#include <kte/elements/line_point_mindist.hpp>
#include <kte/elements/mimic.hpp>
#include <kte/elements/position_control.hpp>
#include <kte/elements/position_measure.hpp>
#include <kte/elements/rotor.hpp>

#include <Eigen/LU>

#include <random>

#include "catch.hpp"

namespace shapes_test {

using namespace kte;

/// Chains of all shapes that an element may have, assembled at random: each algorithm that takes them against the
/// others.

/// Numbers in [-1, 1).
struct draws {
  std::mt19937 engine;
  double operator()() { return static_cast<double>(engine()) * 0x1p-31 - 1; }
  int below(int n) { return static_cast<int>(engine() % static_cast<unsigned>(n)); }
  vec3<> vector() { return {(*this)(), (*this)(), (*this)()}; }
  vec3<> axis() {
    const vec3<> v = vector();
    return (1 / std::sqrt(dot(v, v))) * v;
  }
};

struct cam {
  template <class Q>
  auto operator()(const Q& q) const {
    using std::sin;
    return Q(0.7 * q + 0.2 * sin(q));
  }
};
struct product {
  template <class Q>
  auto operator()(const Q& a, const Q& b) const {
    using std::cos;
    return Q(a * cos(b) + 0.5 * b);
  }
};
struct controller {
  template <class U>
  auto operator()(const U& u, const U& reference) const {
    return U(3.0 * (reference - u));
  }
};

struct random_chain {
  runtime_chain chain;
  bool conservative, friction = false;

  /// `quiet`: nothing that gives or takes energy.
  random_chain(unsigned seed, bool with_friction, bool quiet) : conservative(quiet), draw{std::mt19937(seed)} {
    chain.gravity(vec3{0.3, -0.4, -9.81});
    if (!quiet && draw.below(2) == 0) {
      chain << position_control_3D("table.p", "table.v", "table.a", "ground", "table");
      frames = {"table"};
    } else {
      frames = {"ground"};
    }
    const int bodies = 3 + draw.below(4);
    for (int i = 0; i < bodies; ++i) add_body(with_friction);
    for (int i = 0; i < 3; ++i) add_force(i);
  }

 private:
  draws draw;
  std::vector<std::string> frames, coordinates;
  std::size_t joints = 0;

  const std::string& any(const std::vector<std::string>& of) {
    return of[static_cast<std::size_t>(draw.below(static_cast<int>(of.size())))];
  }
  static std::string number(const char* what, std::size_t i) { return what + std::to_string(i); }

  /// A coordinate of a new joint: a degree of freedom, or a follower, or a prescribed coordinate.
  std::string add_coordinate() {
    const std::string q = number("q", joints++);
    const int how = coordinates.empty() ? 0 : draw.below(8);
    if (how == 1) chain << mimic_gen(any(coordinates), q, 0.8, 0.1);
    if (how == 2) chain << differential_gen(any(coordinates), any(coordinates), q, 0.6, -0.7);
    if (how == 3) chain << law_follower_gen(cam{}, any(coordinates), q);
    if (how == 4) chain << law_follower_gen(product{}, any(coordinates), any(coordinates), q);
    if (how == 5 && !conservative) {
      chain << position_control_gen(q + ".p", q + ".v", q + ".a", q);
    } else {
      coordinates.push_back(q);
    }
    return q;
  }
  void add_body(bool with_friction) {
    const std::size_t i = frames.size();
    const std::string end = number("end", i), tip = number("tip", i), base = any(frames);
    const int what = draw.below(with_friction ? 6 : 4);
    if (what >= 4) {
      chain << dry_revolute_joint_3D(add_coordinate(), base, end, draw.axis(), 0.02, 0.1);
      friction = true;
    } else if (what == 0) {
      chain << prismatic_joint_3D(add_coordinate(), base, end, draw.axis());
    } else if (what == 1 && i < 3) {
      chain << spherical_joint_3D(number("ball", i), base, end);
    } else {
      chain << revolute_joint_3D(add_coordinate(), base, end, draw.axis());
    }
    chain << inertia_3D(end, rigid_body{1.5, 0.1 * draw.vector(), sym3{0.3, 0.01, -0.02, 0.25, 0.03, 0.2}})
          << rigid_link_3D(end, tip, 0.4 * draw.vector());
    frames.push_back(tip);
    if (draw.below(2) == 0 && !coordinates.empty()) chain << rotor_3D(any(coordinates), tip, draw.axis(), 30.0, 1e-4);
  }
  void add_force(int i) {
    const std::string name = std::to_string(i);
    switch (draw.below(conservative ? 3 : 5)) {
      case 0:
        chain << spring_3D(any(frames), any(frames), 0.3, 40.0);
        break;
      case 1:
        chain << line_point_mindist_3D(any(frames), "foot" + name, draw.axis(), 0.3 * draw.vector())
              << spring_3D("foot" + name, any(frames), 0.1, 70.0);
        break;
      case 2:
        chain << position_measure_3D(any(frames), "seen" + name);  // on which nothing depends
        break;
      case 3:
        if (coordinates.empty()) return;
        chain << position_measure_gen(any(coordinates), "is" + name)
              << law_signal(controller{}, "is" + name, "wanted" + name, "drive" + name)
              << driving_actuator_gen(any(coordinates), "drive" + name);
        break;
      default:
        chain << damper_3D(any(frames), any(frames), 2.0);
    }
  }
};

Eigen::VectorXd random_vector(draws& draw, int n) {
  Eigen::VectorXd x(n);
  for (auto& i : x) i = draw();
  return x;
}
Eigen::VectorXd random_configuration(draws& draw, const runtime_chain& c) {
  return integrate(c, neutral_configuration(c), random_vector(draw, c.dofs()), 1.0);
}
runtime_state random_state(draws& draw, const runtime_chain& c) {
  auto s = c.make_state();
  for (const auto& x : c.wiring().signals) {
    if (x.what == kind::vector)
      s.get<kind::vector>(x.slot) = 0.5 * draw.vector();
    else
      s.get<kind::input>(x.slot) = draw();
  }
  return s;
}
double difference_of(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / std::max(1.0, b.lpNorm<Eigen::Infinity>());
}

TEST_CASE("chains of all shapes: algorithms agree") {
  int conservative = 0, with_friction = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const random_chain x(seed, seed % 3 == 0, seed % 3 == 1);
    const auto& c = x.chain;
    INFO("seed " << seed);
    draws draw{std::mt19937(seed + 1000)};
    auto s = random_state(draw, c);
    const Eigen::VectorXd q = random_configuration(draw, c), v = random_vector(draw, c.dofs()),
                          a = random_vector(draw, c.dofs());
    if (c.dofs() == 0) continue;
    const Eigen::VectorXd tau = inverse_dynamics(c, s, q, v, a);

    // the passes, element by element
    c.doMotion(s), c.clearForce(s), c.doForce(s);
    CHECK(difference_of(-forces(s), tau) < 1e-13);

    const Eigen::MatrixXd m = mass_matrix(c, s, q);
    const double condition = m.norm() * m.inverse().norm();
    CHECK(difference_of(forward_dynamics(c, s, q, v, tau), a) < 1e-15 * condition * std::max(1.0, tau.norm()));
    CHECK(m == m.transpose());  // to the last bit
    with_friction += x.friction;
    if (x.friction) continue;

    // M by columns
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(c.dofs()), bias = inverse_dynamics(c, s, q, v, none);
    Eigen::MatrixXd columns(c.dofs(), c.dofs());
    for (int j = 0; j < c.dofs(); ++j)
      columns.col(j) = inverse_dynamics(c, s, q, v, Eigen::VectorXd::Unit(c.dofs(), j)) - bias;
    CHECK(difference_of(m, columns) < 1e-14 * std::max(1.0, bias.norm()));
    CHECK(difference_of(mass_matrix_inverse(c, s, q) * m, Eigen::MatrixXd::Identity(c.dofs(), c.dofs())) <
          1e-15 * condition);

    // derivatives, by differences
    const auto r = inverse_dynamics_derivatives(c, s, q, v, a);
    Eigen::MatrixXd by_q(c.dofs(), c.dofs()), by_v(by_q);
    const double h = 1e-5;
    for (int j = 0; j < c.dofs(); ++j) {
      const Eigen::VectorXd d = Eigen::VectorXd::Unit(c.dofs(), j);
      const auto at = [&](double t) -> Eigen::VectorXd { return inverse_dynamics(c, s, integrate(c, q, d, t), v, a); };
      const auto with = [&](double t) -> Eigen::VectorXd { return inverse_dynamics(c, s, q, v + t * d, a); };
      by_q.col(j) = (at(h) - at(-h)) / (2 * h), by_v.col(j) = (with(h) - with(-h)) / (2 * h);
    }
    CHECK(difference_of(r.by_q, by_q) < 1e-7);
    CHECK(difference_of(r.by_v, by_v) < 1e-7);
    CHECK(difference_of(r.by_a, m) < 1e-15);

    // power
    if (!x.conservative) continue;
    ++conservative;
    const auto energy_at = [&](double t) {
      const auto e = energy(c, s, integrate(c, q, v + t / 2 * a, t), v + t * a);
      return e.kinetic + e.potential;
    };
    CHECK((energy_at(h) - energy_at(-h)) / (2 * h) == within(v.dot(tau), 1e-7 * std::max(1.0, tau.norm())));
  }
  CHECK(conservative > 40);
  CHECK(with_friction > 10);
}

TEST_CASE("what algorithms cannot count they refuse by name") {
  const auto says = [](const char* text) {
    return Catch::Predicate<bad_argument>(
        [text](const bad_argument& e) { return std::string(e.what()).find(text) != std::string::npos; }, text);
  };
  runtime_chain dry;
  dry << dry_revolute_joint_3D("q", "ground", "end", axis::y, 0.02)
      << inertia_3D("end", rigid_body{1.5, vec3{0.1, 0.0, 0.0}, diagonal(0.03, 0.025, 0.02)});
  CHECK_THROWS_MATCHES(dry.make_state<float>(), bad_argument, says("dry_revolute_joint_3D"));

  runtime_chain spread;
  spread << revolute_joint_3D("q", "ground", "end", axis::y) << inertia_3D("end", point_mass(1.0, along_x(0.3)))
         << rotor_3D("q", "end", axis::y, 30.0, 1e-4);
  auto t = spread.make_state();
  CHECK_THROWS_MATCHES(torque_regressor(spread, t), bad_argument, says("rotor_3D"));
  CHECK_THROWS_MATCHES(centre_of_mass(spread, t), bad_argument, says("rotor_3D"));
  CHECK_THROWS_MATCHES(spread.make_state<float>(), bad_argument, says("rotor_3D"));

  runtime_chain hanging;  // a mass on a frame that follows another
  hanging << revolute_joint_3D("q", "ground", "end", axis::y) << inertia_3D("end", point_mass(1.0, along_x(0.3)))
          << line_point_mindist_3D("end", "foot", axis::x, vec3{0.0, 0.1, 0.0}) << inertia_3D("foot", point_mass(1.0));
  auto u = hanging.make_state();
  CHECK_THROWS_MATCHES(forward_dynamics(hanging, u), bad_argument,
                       says("inertia_3D (frame 'foot') has a mass on a frame that follows"));

  runtime_chain linked;  // a link on a frame that is given in another that moves
  linked << revolute_joint_3D("q", "ground", "end", axis::y) << inertia_3D("end", point_mass(1.0, along_x(0.3)))
         << position_control_3D("p", "v", "a", "end", "slide") << rigid_link_3D("slide", "tip", along_x(1.0));
  auto w = linked.make_state();
  CHECK_THROWS_MATCHES(mass_matrix(linked, w), bad_argument,
                       says("rigid_link_3D (base 'slide', end 'tip') stands on a frame that follows others"));
}

}  // namespace shapes_test
