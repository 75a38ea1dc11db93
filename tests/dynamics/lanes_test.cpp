#include <kte/dynamics/lanes.hpp>
#include <kte/loops.hpp>

#include <array>
#include <string>
#include <vector>

#include "catch.hpp"
#include "chain/models.hpp"
#include "closed_loops/mechanisms.hpp"
#include "random.hpp"

// Runtime chains with other parameters in each lane, against a chain of each lane.

namespace lanes_test {

using kte::test::says;
using namespace kte;
using P = pack<double, 8>;

P ramp(double first, double step) {
  P x;
  for (std::size_t i = 0; i < 8; ++i) x.set(i, first + step * static_cast<double>(i));
  return x;
}
/// Parameters of lanes, and those of one lane as numbers.
struct varied {
  std::vector<std::string> paths;
  std::vector<P> values;

  void add(std::string path, const P& x) { paths.push_back(std::move(path)), values.push_back(x); }
  runtime_chain all(const runtime_chain& c) const {
    std::vector<parameter<P>> p;
    for (std::size_t k = 0; k < paths.size(); ++k) p.push_back({paths[k], values[k]});
    return lanes(c, std::span<const parameter<P>>(p));
  }
  runtime_chain one(const runtime_chain& c, std::size_t lane) const {
    std::vector<parameter<double>> p;
    for (std::size_t k = 0; k < paths.size(); ++k) p.push_back({paths[k], values[k][lane]});
    return lanes(c, std::span<const parameter<double>>(p));
  }
};

/// A random tree of bodies in space with elements of all kinds, and parameters that vary.
struct random_tree {
  runtime_chain chain;
  varied parameters;

  explicit random_tree(random_numbers& random) {
    const auto about = [&random](double size) {
      P x;
      for (std::size_t i = 0; i < 8; ++i) x.set(i, size * (1 + 0.5 * random()));
      return x;
    };
    const auto axis = [&random] {
      const vec3<> a{random(), random(), random()};
      return vec3<>((1 / std::sqrt(dot(a, a))) * a);
    };
    const int n = 3 + static_cast<int>(3.5 * (1 + random()));
    std::vector<std::string> ends{"world"};
    chain << base_3D("world");
    for (int i = 0; i < n; ++i) {
      const auto s = std::to_string(i);
      const std::string base =
          ends[static_cast<std::size_t>(0.4999 * (1 + random()) * static_cast<double>(ends.size()))];
      const vec3<> offset{random(), random(), random()};
      switch (static_cast<int>(3.4999 * (1 + random()))) {
        case 0:
          chain << prismatic_joint_3D("q" + s, base, "j" + s, axis());
          break;
        case 1:
          chain << spherical_joint_3D("q" + s, base, "j" + s);
          break;
        case 2:
          chain << dry_revolute_joint_3D("q" + s, base, "j" + s, axis(), 0.02, 0.3);
          parameters.add("q" + s + "/friction_radius", about(0.02));
          break;
        case 3:
          chain << revolute_joint_3D("q" + s, base, "j" + s, kte::axis::y) << inertia_gen("q" + s, 0.4)
                << joint_damping_gen("q" + s, 0.5);
          parameters.add("q" + s + "/damping", about(0.5)), parameters.add("q" + s + "/mass", about(0.4));
          break;
        case 4:
          if (i > 1) {
            chain << revolute_joint_3D("m" + s, base, "p" + s, axis()) << inertia_3D("p" + s, point_mass(1.0))
                  << mimic_gen("m" + s, "q" + s, -1.5) << revolute_joint_3D("q" + s, "p" + s, "j" + s, axis());
            parameters.add("p" + s + "/mass", about(2));
            break;
          }
          [[fallthrough]];
        default:
          chain << revolute_joint_3D("q" + s, base, "j" + s, axis()).at(offset);
      }
      chain << rigid_link_3D("j" + s, "e" + s, vec3<>{random(), random(), random()})
            << inertia_3D("e" + s, rigid_body<>{2.0, vec3<>{0.1, 0, 0.2}, sym3<>{0.3, 0.02, 0, 0.4, 0, 0.5}});
      parameters.add("e" + s + "/mass", about(2)), parameters.add("e" + s + "/com/y", about(0.1));
      parameters.add("e" + s + "/position/z", about(0.5));
      ends.push_back("e" + s);
    }
    chain << spring_3D("world", ends.back(), 0.4, 30.0) << damper_3D(ends[1], ends.back(), 2.0);
    parameters.add("gravity/z", about(-9.81));
    chain.gravity(vec3<>{0.3, 0, -9.81});
  }
};

struct state_and_input {
  Eigen::VectorXd q, v, x;
};
/// The largest difference of lanes from chains of their parameters, relative to the largest number.
template <class Chain, class Make>
double worst_lane(const Chain& c, const varied& parameters, const Make& make) {
  const auto all = parameters.all(c);
  auto s = make_state<P>(all);
  std::array<state_and_input, 8> m;
  runtime_vector<P> q(c.nq()), v(c.dofs()), x(c.dofs());
  for (std::size_t i = 0; i < 8; ++i) {
    m[i] = make(parameters.one(c, i));
    for (int k = 0; k < q.size(); ++k) q[k].set(i, m[i].q[k]);
    for (int k = 0; k < v.size(); ++k) v[k].set(i, m[i].v[k]), x[k].set(i, m[i].x[k]);
  }
  double worst = 0;
  const auto compare = [&](const auto& lanes, const auto& one, std::size_t i) {
    double gap = 0, size = 1;
    for (Eigen::Index k = 0; k < one.size(); ++k) {
      gap = test::worse(gap, std::abs(lanes.data()[k][i] - one.data()[k]));
      size = test::worse(size, std::abs(one.data()[k]));
    }
    worst = test::worse(worst, gap / size);
  };
  const runtime_vector<P> a = forward_dynamics(all, s, q, v, x);
  runtime_vector<P> tau = a;
  runtime_matrix<P> mass = runtime_matrix<P>::Zero(1, 1);
  const bool open = !detail::has_loops(c);
  if (open) tau = inverse_dynamics(all, s, q, v, x), mass = mass_matrix(all, s, q);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto one = parameters.one(c, i);
    auto state = one.make_state();
    const state_and_input& at = m[i];
    compare(a, Eigen::VectorXd(forward_dynamics(one, state, at.q, at.v, at.x)), i);
    if (!open) continue;
    compare(tau, Eigen::VectorXd(inverse_dynamics(one, state, at.q, at.v, at.x)), i);
    compare(mass, Eigen::MatrixXd(mass_matrix(one, state, at.q)), i);
  }
  return worst;
}

TEST_CASE("random runtime chains in lanes: each lane is the chain of its parameters") {
  random_numbers random(39);
  for (int k = 0; k < 30; ++k) {
    const random_tree t(random);
    INFO("chain " << k);
    CHECK(worst_lane(t.chain, t.parameters, [&](const runtime_chain& c) {
            const auto drawn = [&] { return Eigen::VectorXd::NullaryExpr(c.dofs(), [&] { return random(); }).eval(); };
            return state_and_input{integrate(c, neutral_configuration(c), drawn(), 1.0), drawn(), drawn()};
          }) < 1e-13);
  }
}

TEST_CASE("lanes of closed loops: other links, bodies and closures in each lane") {
  using namespace kte::test::loops;
  const auto on_loop = [](const runtime_chain& c, const Eigen::VectorXd& guess) {
    auto s = c.make_state();
    state_and_input m{assemble(c, s, guess), {}, Eigen::VectorXd::Constant(c.dofs(), 0.7)};
    m.v = consistent_velocities(c, s, m.q, Eigen::VectorXd::Constant(c.dofs(), 0.3).eval());
    return m;
  };
  varied p;
  p.add("k0/mass", ramp(1, 0.25)), p.add("t1/position/x", ramp(0.8, 0.05)), p.add("gravity/y", ramp(-9, -0.2));
  CHECK(worst_lane(four_bars(2), p, [&](const runtime_chain& c) { return on_loop(c, four_bar_numbers(2, 0.4)); }) <
        1e-12);
  varied rod;
  rod.add("rod/length", ramp(0.9, 0.03)), rod.add("b/mass", ramp(1, 0.5));
  CHECK(worst_lane(pendulum(), rod, [&](const runtime_chain& c) { return on_loop(c, Eigen::Vector2d(0.6, -0.6)); }) <
        1e-12);
}

TEST_CASE("lanes of runtime chains: a joint that is simpler in some lanes, floats, chains of chains") {
  runtime_chain c;
  c << screw_joint_3D("q", "world", "nut", axis::z, 0.1) << rigid_link_3D("nut", "tip", vec3<>{0.3, 0, 0})
    << inertia_3D("tip", rigid_body<>{1.0, vec3<>{0.1, 0, 0}, sym3<>{0.1, 0, 0, 0.1, 0, 0.1}});
  c.gravity(vec3<>{0, 0, -9.81});
  const auto draw = [](const runtime_chain&) {
    return state_and_input{Eigen::VectorXd::Constant(1, 0.3), Eigen::VectorXd::Constant(1, 0.5),
                           Eigen::VectorXd::Ones(1)};
  };
  varied p;
  p.add("nut/pitch", ramp(-0.2, 0.1));  // zero in lane 2: it turns only
  CHECK(worst_lane(c, p, draw) < 1e-14);

  using F = pack<float, 16>;
  F masses;
  for (std::size_t i = 0; i < 16; ++i) masses.set(i, 1 + 0.5f * static_cast<float>(i));
  const auto many = lanes(c, parameter{"tip/mass", masses});
  CHECK(many.lanes() == 16);
  auto s = make_state<F>(many);
  const std::array<F, 1> x{F(0.3f)};
  const auto& a = forward_dynamics(many, s, x, x, x);
  for (const std::size_t i : {0u, 5u, 15u}) {
    const auto single = lanes(c, parameter{"tip/mass", static_cast<double>(masses[i])});
    auto t = single.make_state();
    const std::array at{static_cast<double>(0.3f)};
    CHECK(static_cast<double>(a[0][i]) == within_relative(forward_dynamics(single, t, at, at, at)[0], 1e-5));
  }

  // lanes of a part, in a larger chain, and lanes of lanes
  runtime_chain whole;
  whole << c << revolute_joint_3D("r", "tip", "end", axis::x) << inertia_3D("end", point_mass(0.5, along_y(0.2)));
  const auto first = lanes(whole, parameter{"nut/pitch", ramp(0.1, 0.1)});
  const auto both = lanes(first, parameter{"end/mass", ramp(0.5, 0.1)}, parameter{"gravity/x", ramp(0, 1)});
  varied together;
  together.add("nut/pitch", ramp(0.1, 0.1)), together.add("end/mass", ramp(0.5, 0.1));
  together.add("gravity/x", ramp(0, 1));
  const auto all = together.all(whole);
  auto at_once = make_state<P>(all), one_by_one = make_state<P>(both);
  const std::array<P, 2> y{P(0.3), P(-0.4)};
  const runtime_vector<P> expected = forward_dynamics(all, at_once, y, y, y);
  const auto& got = forward_dynamics(runtime_chain(both), one_by_one, y, y, y);  // of a copy, which has its lanes
  for (std::size_t i = 0; i < 8; ++i) CHECK(got[1][i] == expected[1][i]);
}

TEST_CASE("lanes of runtime chains that are not there, or not allowed, by name and lane") {
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5))
    << inertia_2D("tip", planar_body(1.0, 0.1)) << joint_damping_gen("q", 0.5);
  P bad = ramp(1, 1);
  bad.set(3, -1);
  CHECK_THROWS_MATCHES(lanes(c, parameter{"tip/mass", bad}), bad_parameter,
                       says("kte: lane 3: inertia_2D (frame 'tip'): mass must be finite and not negative, got -1"));
  CHECK_THROWS_MATCHES(lanes(c, parameter{"tip/weight", 1.0}), unknown_name, says("no parameter 'tip/weight'"));
  CHECK_THROWS_MATCHES(lanes(c, parameter{"tip/position/y", 1.0}), bad_argument, says("typed constant"));
  CHECK_THROWS_MATCHES(lanes(c, parameter{"gravity/y", bad * (1 / P(0.0))}), bad_parameter,
                       says("gravity must be finite"));
  const auto eight = lanes(c, parameter{"tip/mass", ramp(1, 1)}, parameter{"gravity/y", ramp(-9, -1)});
  CHECK_THROWS_MATCHES(eight.make_state(), bad_argument, says("this chain has 8 lanes"));
  CHECK_THROWS_MATCHES(lanes(eight, parameter{"tip/mass", pack<double, 4>(1.0)}), bad_argument, says("has 8 lanes"));
  CHECK_THROWS_MATCHES(record_of(eight), bad_argument, says("other parameters in each lane"));
  runtime_chain other;
  CHECK_THROWS_MATCHES(other << eight, bad_argument, says("gravity in lanes"));
  auto s = make_state<P>(c);
  const std::array<P, 1> x{P(0.3)};
  CHECK_THROWS_MATCHES(forward_dynamics(eight, s, x, x, x), bad_argument, says("made for another chain"));
  c << brake_gen("q", "mode", "force");
  CHECK_THROWS_MATCHES(make_state<P>(c), bad_argument, says("may hold its coordinate"));
}

}  // namespace lanes_test
