#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"

// Linkages that move although their rows are more than their coordinates less one, from the literature.

namespace over_constrained_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;

const rigid_body<> body{1.0, vec3<>{0.3, 0.1, 0.05}, sym3<>{0.02, 0, 0, 0.1, 0, 0.11}};

/// A loop of hinges about z, without offsets: links of lengths a, each along x, and twists alpha about it. The last one
/// is the base, and its hinge closes the loop.
struct link {
  double a, alpha;
};
runtime_chain loop_of_hinges(const std::vector<link>& links) {
  runtime_chain c;
  c.gravity(along_z(-9.81));
  std::string from = "base";
  for (std::size_t i = 1; i < links.size(); ++i) {
    const auto n = std::to_string(i);
    c << revolute_joint_3D("q" + n, from, "j" + n, axis::z) << inertia_3D("j" + n, body)
      << rigid_link_3D("j" + n, "e" + n, along_x(links[i - 1].a), rotation_about(axis::x, links[i - 1].alpha));
    from = "e" + n;
  }
  const mat3<vec3<>> back = as<double>(matrix(rotation_about(axis::x, -links.back().alpha)));
  c << rigid_link_3D("base", "f", back * vec3<>{-links.back().a, 0, 0}, back) << hinge_3D("hinge", "f", from, axis::z);
  return c;
}
/// Myard's 5R linkage, plane-symmetric (Baker, Mechanism and Machine Theory 14, 1979): a12 = a51 = sin(alpha12),
/// a23 = a45 = 1, a34 = 0, alpha23 = alpha45 = pi/2, alpha51 = pi - alpha12, alpha34 = pi - 2 alpha12.
runtime_chain myard() {
  const double alpha = 0.7, a = std::sin(alpha);
  return loop_of_hinges({{a, alpha}, {1, pi / 2}, {0, pi - 2 * alpha}, {1, pi / 2}, {a, pi - alpha}});
}
/// Schatz' 6R linkage, the mechanism of the Turbula mixer: three links of 1 m between right angles, and parallel shafts
/// at sqrt(3) m.
runtime_chain schatz() {
  return loop_of_hinges({{0, pi / 2}, {1, pi / 2}, {1, pi / 2}, {1, pi / 2}, {0, pi / 2}, {std::sqrt(3.0), 0}});
}
/// A spherical platform on three legs of three hinges, all axes through one point and at right angles in a leg.
runtime_chain agile_eye() {
  runtime_chain c;
  c.gravity(along_z(-9.81)) << revolute_joint_3D("a1", "base", "A1", axis::x) << inertia_3D("A1", body)
                            << revolute_joint_3D("b1", "A1", "B1", axis::y) << inertia_3D("B1", body)
                            << revolute_joint_3D("c1", "B1", "eye", axis::z) << inertia_3D("eye", body)
                            << revolute_joint_3D("a2", "base", "A2", axis::y) << inertia_3D("A2", body)
                            << revolute_joint_3D("b2", "A2", "B2", axis::z) << inertia_3D("B2", body)
                            << revolute_joint_3D("a3", "base", "A3", axis::z) << inertia_3D("A3", body)
                            << revolute_joint_3D("b3", "A3", "B3", axis::x) << inertia_3D("B3", body)
                            << hinge_3D("leg2", "B2", "eye", axis::x) << hinge_3D("leg3", "B3", "eye", axis::y);
  return c;
}

/// Simulates there and back: loops stay closed, energy is kept, and the end is the start.
void check_there_and_back(const runtime_chain& c, const vector& q, const vector& v, double t) {
  const manipulator_dynamics_model<runtime_chain> m(c);
  auto s = c.make_state();
  const vector x0 = m.make_x(q, v);
  const auto energy_at = [&](const vector& x) {
    const auto e = energy(c, s, vector(m.positions_of(x)), vector(m.velocities_of(x)));
    return e.kinetic + e.potential;
  };
  prince_dormand87 solver(std::cref(m), 0.0, x0, {.absolute = 1e-10, .relative = 1e-10});
  double open = 0, energy_off = 0;
  solver.integrate(t, every(t / 20), [&](double, const vector& x) {
    open = (std::max)(open, open_by(c, s, m, x));
    energy_off = (std::max)(energy_off, std::abs(energy_at(x) - energy_at(x0)));
  });
  CHECK((solver.state() - x0).cwiseAbs().maxCoeff() > 0.3);
  CHECK(open < 1e-13);
  CHECK(energy_off < 1e-7);
  solver.integrate(0.0);
  CHECK((solver.state() - x0).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("linkages of five and six hinges have mobility 1 at all angles") {
  struct linkage {
    runtime_chain c;
    int rank;
  };
  for (const auto& x : {linkage{myard(), 3}, linkage{schatz(), 4}}) {
    auto s = x.c.make_state();
    for (const double q1 : {0.4, 1.7}) {
      vector q = vector::Zero(x.c.dofs());
      q[0] = q1;
      const auto all = assemblies(x.c, s, 30, q, held("q1"));
      CHECK(all.size() == 2);
      for (const auto& at : all) {
        const auto r = kte::loops(x.c, s, at);
        CHECK((r.rows == 5 && r.rank == x.rank && r.mobility == 1 && r.gap < 1e-14));
      }
      if (q1 > 1) continue;
      const vector v = loop_motion(x.c, s, all[0], actuated("q1")) * 1.5;
      check_there_and_back(x.c, all[0], v, 1);
    }
  }
}

TEST_CASE("a spherical platform on three legs has ten rows of rank four") {
  const auto c = agile_eye();
  auto s = c.make_state();
  const vector q = vector::Zero(7);
  const auto r = kte::loops(c, s, q);
  CHECK((r.rows == 10 && r.rank == 4 && r.mobility == 3 && r.gap == 0));
  // at home its motion is isotropic: each motor turns the eye about its own axis
  const Eigen::MatrixXd turns = jacobian(c, s, q, "eye", in_world_axes, actuated("a1", "a2", "a3")).bottomRows(3);
  CHECK((turns - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-15);
  const vector v = loop_motion(c, s, q, actuated("a1", "a2", "a3")) * Eigen::Vector3d(1, -0.7, 0.4);
  check_there_and_back(c, q, v, 0.5);
}

}  // namespace over_constrained_test
