#pragma once

#include <kte/dynamics/contacts/contact_jacobian.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>

#include <Eigen/Cholesky>

namespace kte {

namespace detail {
/// W of contacts, by the factor B of contact_rows.hpp.
Eigen::MatrixXd delassus_at_state(const runtime_chain& c, runtime_state& s, const chosen_contacts& of);
/// W = J M^-1 J^T.
Eigen::MatrixXd mobility_of(const Eigen::MatrixXd& j, const Eigen::MatrixXd& inverse_of_mass);
/// W^-1; throws `no_solution` for dependent rows of J, of what is called `of`.
Eigen::MatrixXd inverse_of_mobility(const Eigen::MatrixXd& w, const std::string& of);
}  // namespace detail

/// The Delassus matrix W = J M^-1 J^T of contacts, 1/kg, with J of `contact_jacobian`: forces f on them change their
/// accelerations by W f. Closures of loops are not included. In trees articulated bodies pass unit forces from each
/// contact to its base (tree/loop_loads.hpp), without J and M.
template <indexable Q>
Eigen::MatrixXd delassus_matrix(const runtime_chain& c, runtime_state& s, const Q& q, const chosen_contacts& of) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::delassus_at_state(c, s, of); });
}
/// The operational-space inertia (J M^-1 J^T)^-1 of contacts, kg (Khatib, IEEE J. Robotics and Automation 3, 1987): the
/// forces on them for unit accelerations. Throws `no_solution` if rows of J are dependent, as those of four points of
/// one rigid body are.
template <indexable Q>
Eigen::MatrixXd operational_inertia(const runtime_chain& c, runtime_state& s, const Q& q, const chosen_contacts& of) {
  return detail::inverse_of_mobility(delassus_matrix(c, s, q, of), "these contacts");
}
/// The operational-space inertia of a frame, 6 x 6: kg, kg m, kg m^2, with `jacobian` in its axes.
template <indexable Q>
Eigen::MatrixXd operational_inertia(const runtime_chain& c, runtime_state& s, const Q& q, const name_or_handle& frame) {
  const Eigen::MatrixXd j = jacobian(c, s, q, frame);
  return detail::inverse_of_mobility(detail::mobility_of(j, mass_matrix_inverse(c, s, q)), "this frame");
}
template <indexable Q>
Eigen::MatrixXd operational_inertia(const runtime_chain& c, runtime_state& s, const Q& q, const name_or_handle& frame,
                                    in_world_axes_t axes) {
  const Eigen::MatrixXd j = jacobian(c, s, q, frame, axes);
  return detail::inverse_of_mobility(detail::mobility_of(j, mass_matrix_inverse(c, s, q)), "this frame");
}

// ---- static chains: as for runtime chains

template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::MatrixXd delassus_matrix(const static_chain<Gravity, E...>& c, const Q& q,
                                              const chosen_contacts& of) {
  return detail::at_run_time(c, q, [&](auto&... at) { return delassus_matrix(at..., of); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::MatrixXd operational_inertia(const static_chain<Gravity, E...>& c, const Q& q,
                                                  const chosen_contacts& of) {
  return detail::at_run_time(c, q, [&](auto&... at) { return operational_inertia(at..., of); });
}
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] Eigen::MatrixXd operational_inertia(const static_chain<Gravity, E...>& c, const Q& q,
                                                  const Frame& frame) {
  return detail::at_run_time(c, q,
                             [&](auto&... at) { return operational_inertia(at..., detail::text_of_name(frame)); });
}
template <class Gravity, class... E, indexable Q, key_type Frame>
[[nodiscard]] Eigen::MatrixXd operational_inertia(const static_chain<Gravity, E...>& c, const Q& q, const Frame& frame,
                                                  in_world_axes_t axes) {
  return detail::at_run_time(
      c, q, [&](auto&... at) { return operational_inertia(at..., detail::text_of_name(frame), axes); });
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

KTE_FUNCTION Eigen::MatrixXd delassus_at_state(const runtime_chain& c, runtime_state& s, const chosen_contacts& of) {
  const auto chosen = place_contacts(c, s, of, !s.tree().plan.tree);
  auto& m = contact_memory(c, s);
  auto& e = m.equations;
  if (s.tree().plan.tree)
    articulate_at_rest(runtime_elements{c}, s), m.factor.take_articulated(s, e);
  else
    m.factor.factorize(contacts_of(c), s, e);
  m.choose(chosen);
  for (const int i : chosen) m.contacts[static_cast<std::size_t>(i)].basis = {vec3<>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  m.make_matrix_of_tree(contacts_of(c), s);
  return e.places.length * e.places.length * m.w;
}
KTE_FUNCTION Eigen::MatrixXd mobility_of(const Eigen::MatrixXd& j, const Eigen::MatrixXd& inverse_of_mass) {
  return j * inverse_of_mass * j.transpose();
}
KTE_FUNCTION Eigen::MatrixXd inverse_of_mobility(const Eigen::MatrixXd& w, const std::string& of) {
  const Eigen::LDLT<Eigen::MatrixXd> factor(w);
  const auto d = factor.vectorD();
  if (w.size() > 0 && !(d.minCoeff() > 1e-12 * d.maxCoeff()))
    throw no_solution("kte: " + of +
                      " cannot accelerate in all directions here, so there is no operational-space "
                      "inertia: rows of the Jacobian are dependent");
  return factor.solve(Eigen::MatrixXd::Identity(w.rows(), w.cols()));
}

}  // namespace kte::detail
#endif
