#pragma once

#include <kte/dynamics/contacts/chosen_contacts.hpp>
#include <kte/dynamics/jacobian_rate.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>

namespace kte {

namespace detail {
Eigen::MatrixXd contact_jacobian_at_state(const runtime_chain& c, runtime_state& s, const chosen_contacts& of);
Eigen::MatrixXd contact_jacobian_rate_at_state(const runtime_chain& c, runtime_state& s, const chosen_contacts& of);
}  // namespace detail

/// The Jacobian J of contacts: their velocities u, of the point of frame 2 at the contact relative to frame 1, in axes
/// of the surface, m/s, are J v. Three rows per contact, two in the plane; a force f on the body is J^T f on the
/// coordinates. Contacts may be open: J is that of the point where they would touch.
///
///   contact_jacobian(c, s, q, at_contacts("left foot"))       3 x n
///   contact_jacobian(c, s, q, at_contacts())                  of all contacts that touch, in order
///
/// Throws `unknown_name`; `bad_argument` for a chain without contacts. Other errors as for `jacobian`.
template <indexable Q>
Eigen::MatrixXd contact_jacobian(const runtime_chain& c, runtime_state& s, const Q& q, const chosen_contacts& of) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::contact_jacobian_at_state(c, s, of); });
}
template <indexable Q>
Eigen::MatrixXd contact_jacobian(const runtime_chain& c, runtime_state& s, const Q& q, std::string_view contact) {
  return contact_jacobian(c, s, q, at_contacts(std::string(contact)));
}
/// J_dot: the rate of `contact_jacobian` at the velocities v, so that u' = J a + J_dot v with bases at rest.
template <indexable Q, indexable V>
Eigen::MatrixXd contact_jacobian_rate(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                                      const chosen_contacts& of) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v).call([&] { return detail::contact_jacobian_rate_at_state(c, s, of); });
}
template <indexable Q, indexable V>
Eigen::MatrixXd contact_jacobian_rate(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                                      std::string_view contact) {
  return contact_jacobian_rate(c, s, q, v, at_contacts(std::string(contact)));
}

// ---- static chains: as for runtime chains; contacts by keys too

template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto contact_jacobian(const static_chain<Gravity, E...>& c, const Q& q, const chosen_contacts& of) {
  return detail::at_run_time(c, q, [&](auto&... at) { return contact_jacobian(at..., of); });
}
template <class Gravity, class... E, indexable Q, key_type Contact>
[[nodiscard]] auto contact_jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Contact& contact) {
  return contact_jacobian(c, q, at_contacts(contact));
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] Eigen::MatrixXd contact_jacobian_rate(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                                    const chosen_contacts& of) {
  return detail::at_run_time(c, q, v, [&](auto&... at) { return contact_jacobian_rate(at..., of); });
}
template <class Gravity, class... E, indexable Q, indexable V, key_type Contact>
[[nodiscard]] Eigen::MatrixXd contact_jacobian_rate(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                                    const Contact& contact) {
  return contact_jacobian_rate(c, q, v, at_contacts(contact));
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

KTE_FUNCTION Eigen::MatrixXd contact_jacobian_at_state(const runtime_chain& c, runtime_state& s,
                                                       const chosen_contacts& of) {
  const auto chosen = place_contacts(c, s, of, true);
  const auto& m = contact_memory(c, s);
  const Eigen::MatrixXd all = m.equations.dense_jacobian();
  Eigen::MatrixXd j(0, s.dofs());
  for (const int i : chosen) {
    const auto& x = m.place(m.contacts[static_cast<std::size_t>(i)]);
    j.conservativeResize(j.rows() + x.rows.count(), j.cols());
    j.bottomRows(x.rows.count()) = all.middleRows(x.first, x.rows.count());
  }
  return j;
}
/// x with [x] y = x cross y.
inline Eigen::Matrix3d cross_matrix(const vec3<>& x) {
  Eigen::Matrix3d m;
  m << 0, -x.z, x.y, x.z, 0, -x.x, -x.y, x.x, 0;
  return m;
}
/// The rate of the point of a contact in axes of its surface.
inline vec3<> rate_of_point(const kte_element& contact, const closing_motion<double>& m) {
  using D = derivative_number;
  const auto moving = [](const vec3<>& x, const vec3<>& rate) {
    vec3<D> y = as<D>(x);
    y.x.derivative[0] = rate.x, y.y.derivative[0] = rate.y, y.z.derivative[0] = rate.z;
    return y;
  };
  const vec3<> w = m.rotation * m.ang_velocity;  // R' = [w] R
  const mat3<vec3<>>& r = m.rotation;
  const mat3<vec3<>> rate{w.y * r.z - w.z * r.y, w.z * r.x - w.x * r.z, w.x * r.y - w.y * r.x};  // by rows
  const auto point = contact
                         .touch_at(closing_motion<D>{moving(m.position, m.rotation * m.velocity),
                                                     {moving(r.x, rate.x), moving(r.y, rate.y), moving(r.z, rate.z)},
                                                     {},
                                                     {},
                                                     {},
                                                     {}})
                         .point;
  return {point.x.derivative[0], point.y.derivative[0], point.z.derivative[0]};
}
/// With the Jacobians of both frames in axes of the world and the point c at r from a frame,
///
///   J = R_A^T (J_v - [r] J_w of B - the same of A)                                         (1)
///   J_dot = R_A^T (J_v' - [r] J_w' - [r'] J_w of B - the same of A) - R_A^T [w_A] R_A J       (2)
KTE_FUNCTION Eigen::MatrixXd contact_jacobian_rate_at_state(const runtime_chain& c, runtime_state& s,
                                                            const chosen_contacts& of) {
  const auto chosen = place_contacts(c, s, of, false);
  std::vector<std::pair<closure_place, contact_at>> all;
  for (const int i : chosen) {
    const auto& x = contact_memory(c, s).contacts[static_cast<std::size_t>(i)];
    all.emplace_back(contact_memory(c, s).place(x), x);
  }
  Eigen::MatrixXd rates(0, s.dofs());
  for (const auto& [at, x] : all) {
    move(c.wiring(), s, at.frame1), move(c.wiring(), s, at.frame2);
    const auto world = [&](const runtime_frame& frame) {
      return with_motion(s, frame, [](const auto& m) { return as_closing_motion<double>(m); });
    };
    const auto a = world(at.frame1), b = world(at.frame2);
    const auto& r = a.rotation;
    const vec3<> w_a = r * a.ang_velocity;
    const vec3<> r_a = r * x.place.point, r_b = a.position + r_a - b.position;
    const vec3<> r_a_rate = cross(w_a, r_a) + r * rate_of_point(runtime_elements{c}.element(at.element),
                                                                as_closing_motion<double>(relative(a, b)));
    const vec3<> r_b_rate = r * a.velocity + r_a_rate - b.rotation * b.velocity;
    const auto j_a = jacobian_with_rate_of<in_world_axes_t>(c, s, at.frame1),
               j_b = jacobian_with_rate_of<in_world_axes_t>(c, s, at.frame2);
    const Eigen::Matrix3d near_a = cross_matrix(r_a), near_b = cross_matrix(r_b);
    const Eigen::MatrixXd seen = j_b.value.topRows(3) - near_b * j_b.value.bottomRows(3) - j_a.value.topRows(3) +
                                 near_a * j_a.value.bottomRows(3);
    const Eigen::MatrixXd rate = j_b.rate.topRows(3) - near_b * j_b.rate.bottomRows(3) -
                                 cross_matrix(r_b_rate) * j_b.value.bottomRows(3) - j_a.rate.topRows(3) +
                                 near_a * j_a.rate.bottomRows(3) + cross_matrix(r_a_rate) * j_a.value.bottomRows(3);
    Eigen::Matrix3d rotation;
    rotation << r.x.x, r.x.y, r.x.z, r.y.x, r.y.y, r.y.z, r.z.x, r.z.y, r.z.z;
    const int rows = at.rows.count();
    rates.conservativeResize(rates.rows() + rows, rates.cols());
    rates.bottomRows(rows) = (rotation.transpose() * (rate - cross_matrix(w_a) * seen)).topRows(rows);
  }
  return rates;
}

}  // namespace kte::detail
#endif
