#include <kte/contacts.hpp>
#include <kte/control/linearize_loops.hpp>
#include <kte/dynamics/batch.hpp>
#include <kte/dynamics/closed_loops/statics.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/external_wrenches.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/joint_reactions.hpp>
#include <kte/dynamics/momentum_rate.hpp>
#include <kte/dynamics/reduced.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/elements/compliant_contact.hpp>
#include <kte/loops.hpp>
#include <kte/math/pack.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/runtime_models.hpp>
#include <kte/statics.hpp>

#include "catch.hpp"
#include "closed_loops/tangle.hpp"

namespace refused_contacts_test {

using namespace kte;
using namespace kte::test;
using kte::test::loops::vector;

runtime_chain falling_point() {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << prismatic_joint_2D("x", "world", "a", axis::x)
                            << prismatic_joint_2D("y", "a", "point", axis::y) << inertia_2D("point", point_mass(1.0))
                            << point_contact_2D("touches", "world", "point", half_space{}, {0.3, 0});
  return c;
}

TEST_CASE("algorithms without contacts refuse chains with contacts in words, and leave the state") {
  const auto c = falling_point();
  auto s = c.make_state();
  s.coordinate("y").q = 0.25;
  const vector q = vector::Constant(2, 0.5), v = q, x = q;
  const auto refuses = [&](const char* what, const auto& f) {
    INFO(what);
    CHECK_THROWS_MATCHES(f(), bad_argument, says("kte: this algorithm does not support contacts, as"));
    CHECK(s.coordinate("y").q == 0.25);
  };
  refuses("inverse dynamics", [&] { (void)inverse_dynamics(c, s, q, v, x); });
  refuses("inverse dynamics of a state", [&] { (void)inverse_dynamics(c, s); });
  refuses("static forces", [&] { (void)static_forces(c, s, q); });
  refuses("nonlinear effects", [&] { (void)nonlinear_effects(c, s, q, v); });
  refuses("forward dynamics", [&] { (void)forward_dynamics(c, s, q, v, x); });
  refuses("forward dynamics of a state", [&] { (void)forward_dynamics(c, s); });
  refuses("hybrid dynamics", [&] { (void)hybrid_dynamics(c, s, q, v, x, {"x"}); });
  refuses("inverse dynamics derivatives", [&] { (void)inverse_dynamics_derivatives(c, s, q, v, x); });
  refuses("forward dynamics derivatives", [&] { (void)forward_dynamics_derivatives(c, s, q, v, x); });
  refuses("regressor", [&] { (void)torque_regressor(c, s, q, v, x); });
  refuses("joint reaction", [&] { (void)joint_reaction(c, s, q, v, x, "a"); });
  refuses("joint reactions", [&] { (void)joint_reactions(c, s, q, v, x); });
  refuses("momentum rate", [&] { (void)centroidal_momentum_rate(c, s, q, v, x); });
  refuses("centre of mass", [&] { (void)centre_of_mass_acceleration(c, s, q, v, x); });
  refuses("external wrenches", [&] {
    (void)forward_dynamics(c, s, q, v, x, {external_wrench{"point", {1, 0, 0}, {}}});
  });
  refuses("statics", [&] { (void)static_equilibrium(c, s, q); });
  refuses("reduced chains", [&] { (void)reduced(c, q, "x"); });
  const std::vector<double> many{0.5, 0.5};
  std::vector<double> tau(2);
  refuses("batches", [&] { batch::inverse_dynamics(c, many, many, many, tau); });
  const auto by = actuated("x");
  refuses("constrained dynamics", [&] { (void)constrained_dynamics(c, s, q, v, x); });
  refuses("constrained dynamics derivatives", [&] { (void)constrained_dynamics_derivatives(c, s, q, v, x); });
  refuses("actuated dynamics derivatives", [&] { (void)actuated_dynamics_derivatives(c, s, q, v, x, by); });
  refuses("actuated inverse dynamics", [&] { (void)inverse_dynamics(c, s, q, v, x, by); });
  refuses("modes of loops", [&] { (void)natural_modes(c, s, q, by); });
  refuses("statics of loops", [&] { (void)static_equilibrium(c, s, q, by); });
  refuses("linearization of loops", [&] { (void)linearize(c, s, q, v, x, by); });
  refuses("models of inverse dynamics", [&] { inverse_dynamics_model<runtime_chain> model(c); });
}

TEST_CASE("contacts between frames that no joint moves relative to each other are refused by name") {
  const auto refuses = [](runtime_chain c, const char* why) {
    c << prismatic_joint_2D("last", "world", "carried", axis::x) << inertia_2D("carried", point_mass(1.0));
    auto s = c.make_state();
    const vector at = vector::Constant(3, 0.5);
    CHECK_THROWS_MATCHES(contact_dynamics(c, s, at, at, at), bad_argument, says(why));
    CHECK_THROWS_MATCHES(impact(c, s, at, at), bad_argument, says(why));
    CHECK_THROWS_MATCHES(contact_jacobian(c, s, at, "inner"), bad_argument, says(why));
    CHECK_THROWS_MATCHES(
        manipulator_dynamics_model(c).computeStateRate(0.0, manipulator_dynamics_model(c).make_x(at, at)), bad_argument,
        says(why));
    auto packs = c.make_state<pack<double, 4>>();
    const runtime_vector<pack<double, 4>> none = runtime_vector<pack<double, 4>>::Zero(3);
    CHECK_THROWS_MATCHES(contact_dynamics(c, packs, none, none, none), bad_argument, says(why));
  };
  auto c = falling_point();
  c << rigid_link_2D("point", "toe", along_x(0.5)) << point_contact_2D("inner", "point", "toe", half_space{}, {0.3, 0});
  refuses(c,
          "kte: contact 'inner': no joint moves its frames 'point' and 'toe' relative to each other: they are on one");
  c = falling_point();
  c << rigid_link_2D("world", "step", along_x(0.5))
    << point_contact_2D("inner", "world", "step", half_space{}, {0.3, 0});
  refuses(c,
          "kte: contact 'inner': no joint moves its frames 'world' and 'step' relative to each other: they are both");
  c = falling_point();
  c << base_2D("ledge") << point_contact_2D("inner", "world", "ledge", half_space{}, {0.3, 0});
  refuses(c,
          "kte: contact 'inner': no joint moves its frames 'world' and 'ledge' relative to each other: they are both");
}

TEST_CASE("a body on one that is 1e12 times lighter is no jam") {
  const auto stack = [](double mass) {
    runtime_chain c;
    c.gravity(along_y(-9.81)) << prismatic_joint_2D("low", "world", "plate", axis::y)
                              << inertia_2D("plate", point_mass(1.0))
                              << prismatic_joint_2D("high", "world", "block", axis::y)
                              << inertia_2D("block", point_mass(mass))
                              << point_contact_2D("under", "world", "plate", half_space{}, {0.0, 0})
                              << point_contact_2D("over", "plate", "block", half_space{}, {0.0, 0});
    return c;
  };
  const vector none = vector::Zero(2);
  auto c = stack(1e6);
  auto s = c.make_state();
  const auto& r = contact_dynamics(c, s, none, none, none);
  CHECK(std::abs(r.force("under").y / (9.81 * (1e6 + 1)) - 1) < 1e-9);
  CHECK(std::abs(r.force("over").y / (9.81 * 1e6) - 1) < 1e-9);  // rounding of W_11 W_22 - W_12^2 = 1e-6
  c = stack(1e12);
  s = c.make_state();
  CHECK_THROWS_MATCHES(
      contact_dynamics(c, s, none, none, none), no_solution,
      says("kte: the forces of contacts 'under', 'over' cannot be computed: their equations are nearly"));
}

TEST_CASE("a flat disc is refused with the name of its compliant contact") {
  runtime_chain c;
  c << free_joint_3D("pose", "ground", "coin")
    << inertia_3D("coin", rigid_body<>{1.0, vec3<>{0, 0, 0}, sym3<>{0.004, 0, 0, 0.004, 0, 0.004}})
    << compliant_disc_contact_3D("ground", "coin", half_space{}, axis::z, 0.1, {.stiffness = 1e4});
  auto s = c.make_state();
  vector q(7);
  q << 0, 0, -1e-3, 1, 0, 0, 0;
  const vector none = vector::Zero(6);
  const auto is_named = says("compliant_disc_contact_3D (frame1 'ground', frame2 'coin'): a disc lies flat");
  CHECK_THROWS_MATCHES(forward_dynamics(c, s, q, none, none), bad_argument, is_named);
  CHECK_THROWS_MATCHES(forward_dynamics_derivatives(c, s, q, none, none), bad_argument, is_named);
  s.pose_3D("pose").position.z = -1e-3;
  c.doMotion(s), c.clearForce(s);
  CHECK_THROWS_MATCHES(c.doForce(s), bad_argument, is_named);
}

TEST_CASE("a flat disc with a rigid contact moves as its frames do, and has no dynamics") {
  runtime_chain c;
  c << free_joint_3D("pose", "ground", "coin")
    << inertia_3D("coin", rigid_body<>{1.0, vec3<>{0, 0, 0}, sym3<>{0.004, 0, 0, 0.004, 0, 0.004}})
    << disc_contact_3D("rim", "ground", "coin", half_space{}, axis::z, 0.1, {})
    << rigid_link_3D("coin", "edge", along_x(0.1));
  auto s = c.make_state();
  s.pose_3D("pose").position.x = 2;
  c.doMotion(s);
  CHECK((s.frame_3D("edge").position.x == 2.1 && s.contact("rim").gap == 0 && s.contact("rim").point.x == 2));
  vector q(7);
  q << 0, 0, 0, 1, 0, 0, 0;
  const vector none = vector::Zero(6);
  CHECK_THROWS_MATCHES(contact_dynamics(c, s, q, none, none), bad_argument, says("a disc lies flat on its surface"));
}

}  // namespace refused_contacts_test
