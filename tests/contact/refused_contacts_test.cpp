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
#include <kte/loops.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/runtime_models.hpp>
#include <kte/statics.hpp>

#include "catch.hpp"
#include "closed_loops/tangle.hpp"

using namespace kte;
using namespace kte::test;
using kte::test::loops::vector;

namespace {

runtime_chain falling_point() {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << prismatic_joint_2D("x", "world", "a", axis::x)
                            << prismatic_joint_2D("y", "a", "point", axis::y) << inertia_2D("point", point_mass(1.0))
                            << point_contact_2D("touches", "world", "point", half_space{}, {0.3, 0});
  return c;
}

}  // namespace

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
