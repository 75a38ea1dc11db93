#pragma once

#include <kte/dynamics/contacts/impact_derivatives.hpp>
#include <kte/events/event_list.hpp>
#include <kte/models/detail/static_model_at_run_time.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

/// Derivatives of states of models with rigid contacts by displacements of the state before, (dq, dv), along the
/// numbers of v; not by internal states.
namespace kte {

namespace detail {
Eigen::MatrixXd contact_variation_matrix(const manipulator_dynamics_model<runtime_chain>& m, double t,
                                         const Eigen::VectorXd& x);
Eigen::MatrixXd contact_saltation_matrix(const manipulator_dynamics_model<runtime_chain>& m, double t,
                                         const Eigen::VectorXd& before, const Eigen::VectorXd& after);
Eigen::MatrixXd contact_projection_matrix(const manipulator_dynamics_model<runtime_chain>& m, double t,
                                          const Eigen::VectorXd& x);
}  // namespace detail

/// The saltation matrix S of an event of rigid contacts: displacements (dq, dv) of motions after it are S times those
/// before, extrapolated to the time of the event. With x' = f, the event g(x) = 0 and its reset R,
///
///   S = DR + (f^+ - DR f^-) Dg/(Dg f^-)          (1)
///
/// g is the gap of the contact that lands, or the velocity of one whose sliding ends or turns back. Where contacts lift
/// or begin to slide, f is continuous and S = 1. Displacements must be those of closed contacts: gaps and slip stay
/// zero.
///
///   const auto report = solver.integrate(10.0, kte::element_events(model));
///   const Eigen::MatrixXd s = kte::saltation_matrix(model, report.events[0]);
///
/// Throws `bad_argument` where S is not defined, because contacts land at one time that may land one after the other,
/// or not known: several impacts at one time, a jam, reduced restitution, internal states of elements, closures.
template <class Model, class X>
[[nodiscard]] Eigen::MatrixXd saltation_matrix(const Model& model, const event_occurrence<X>& event) {
  const auto& m = detail::model_at_run_time(model);
  return detail::contact_saltation_matrix(m, event.time, event.before, event.after);
}

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/dynamics/contacts/contact_derivatives.hpp>
#  include <kte/models/detail/contact_saltation.hpp>

namespace kte::detail {

inline void check_variations(const manipulator_dynamics_model<runtime_chain>& m) {
  if (m.internals() != numbers_of_contact * m.contacts() || m.has_loops() || !m.locks().empty())
    throw bad_argument(
        "kte: derivatives across events of contacts are not known for chains with internal states of elements or with "
        "closures of loops");
}
/// Adds to `put_rate_derivatives` that the state moves from which displacements are measured, with the angular velocity
/// w: those of positions change by -w x d, those of rotations by -w x d/2.
inline void add_variation_of_base(const freedom& f, const Eigen::VectorXd& v, Eigen::MatrixXd& j) {
  if (f.what == kind::gen) return;
  if (f.what == kind::pose_2D) {
    j(f.v, f.v + 1) += v[f.v + 2], j(f.v + 1, f.v) -= v[f.v + 2];
    return;
  }
  const int turning = f.what == kind::pose_3D ? f.v + 3 : f.v;
  Eigen::Matrix3d cross;
  cross << 0, v[turning + 2], -v[turning + 1], -v[turning + 2], 0, v[turning], v[turning + 1], -v[turning], 0;
  if (f.what == kind::pose_3D) j.block<3, 3>(f.v, f.v) += cross;
  j.block<3, 3>(turning, turning) += cross / 2;
}
/// The matrix A of d' = A d, for displacements d between motions in the modes of x.
KTE_FUNCTION Eigen::MatrixXd contact_variation_matrix(const manipulator_dynamics_model<runtime_chain>& model, double t,
                                                      const Eigen::VectorXd& x) {
  check_variations(model);
  runtime_state s = make_state(model.chain());
  model.setJointStates(t, x, s);
  auto& m = contact_memory(model.chain(), s);
  take_passing(s, m);
  forces_in_modes forces;
  accelerate_in_modes(contacts_of(model.chain()), s, m, forces);
  const Eigen::VectorXd a = s.work.forces;
  write_numbers<vector_of::a>(s, a, "a");
  contact_dynamics_derivatives_result by;
  derive_in_modes(model.chain(), s, m, true, by);
  const Eigen::Index n = model.velocity_count();
  Eigen::MatrixXd j(2 * n, 2 * n);
  put_rate_derivatives(model.freedoms(), Eigen::VectorXd(model.velocities_of(x)), by, j);
  const Eigen::VectorXd v = model.velocities_of(x);
  for (const freedom& f : model.freedoms()) add_variation_of_base(f, v, j);
  return j;
}

KTE_FUNCTION Eigen::MatrixXd contact_saltation_matrix(const manipulator_dynamics_model<runtime_chain>& m, double t,
                                                      const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  check_variations(m);
  return contact_saltation(m, t, before, after).matrix();
}
/// The projection of displacements from x onto those that keep contacts closed.
KTE_FUNCTION Eigen::MatrixXd contact_projection_matrix(const manipulator_dynamics_model<runtime_chain>& m, double t,
                                                       const Eigen::VectorXd& x) {
  check_variations(m);
  return contact_saltation(m, t, x, x).projection();
}

}  // namespace kte::detail
#endif
