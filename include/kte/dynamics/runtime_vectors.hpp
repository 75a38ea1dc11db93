#pragma once

#include <kte/chain/runtime_state.hpp>
#include <kte/dynamics/detail/blame.hpp>
#include <kte/dynamics/state_vectors.hpp>

/// The numbers of a runtime state as vectors, as dynamics/state_vectors.hpp has them for static chains.
namespace kte {

namespace detail {
template <vector_of Which>
Eigen::VectorXd read_numbers(const runtime_state& s) {
  Eigen::VectorXd x(Which == vector_of::q ? s.nq() : s.dofs());
  read_listed_numbers<Which>(s, x);
  return x;
}
/// Numbers of x into a coordinate.
template <vector_of Which, class C, class X>
void put(C& c, const freedom& at, const X& x) {
  auto i = begin_of<Which>(at);
  visit_numbers<Which>(c, [&](double& number) { number = static_cast<double>(x[i++]); });
}
template <vector_of Which, indexable X>
void write_numbers(runtime_state& s, const X& x, const char* name) {
  if constexpr (Which == vector_of::q)
    check_configuration(s.nq(), s.dofs(), x);
  else
    check_size(static_cast<std::size_t>(s.dofs()), x, name);
  for_each_listed_freedom(s, [&x](auto& c, const freedom& at) { put<Which>(c, at, x); });
}
inline std::vector<layout_entry<>> layout_of_state(const runtime_state& s) {
  std::vector<layout_entry<>> layout;
  for (const auto& f : s.freedoms())
    layout.push_back({s.made_for()->names[static_cast<std::size_t>(f.what)][static_cast<std::size_t>(f.slot)], f.what,
                      f.q, nq_of(f.what), f.v, nv_of(f.what)});
  return layout;
}
/// Throws `bad_argument` that names the number at fault, of those in the state and of `tau`.
[[noreturn, gnu::cold]] inline void blame(const char* what, const runtime_state& s, const Eigen::VectorXd& tau = {}) {
  const auto layout = layout_of_state(s);
  const auto span = [](const Eigen::VectorXd& x) {
    return std::span<const double>(x.data(), static_cast<std::size_t>(x.size()));
  };
  const auto q = read_numbers<vector_of::q>(s), v = read_numbers<vector_of::v>(s), a = read_numbers<vector_of::a>(s);
  raise_if_no_rotation(layout, span(q));
  if (tau.size() > 0) raise_not_finite(what, layout, {{"q", span(q), true}, {"v", span(v)}, {"tau", span(tau)}});
  raise_not_finite(what, layout, {{"q", span(q), true}, {"v", span(v)}, {"a", span(a)}});
}
/// As on static chains: a mass of coordinate `row` that cannot be used.
[[noreturn, gnu::cold]] inline void blame_mass(const runtime_state& s, int row, bool finite) {
  const auto layout = layout_of_state(s);
  if (finite) raise_singular_mass_matrix(name_of_row(layout, row));
  const auto q = read_numbers<vector_of::q>(s);
  const argument positions{"q", {q.data(), static_cast<std::size_t>(q.size())}, true};
  if (!culprit(layout, {positions}).empty()) raise_not_finite("a mass", layout, {positions});
  raise_endless_mass(name_of_row(layout, row));
}
}  // namespace detail

inline Eigen::VectorXd positions(const runtime_state& s) { return detail::read_numbers<detail::vector_of::q>(s); }
inline Eigen::VectorXd velocities(const runtime_state& s) { return detail::read_numbers<detail::vector_of::v>(s); }
inline Eigen::VectorXd accelerations(const runtime_state& s) { return detail::read_numbers<detail::vector_of::a>(s); }
inline Eigen::VectorXd forces(const runtime_state& s) { return detail::read_numbers<detail::vector_of::f>(s); }

template <indexable X>
void set_positions(runtime_state& s, const X& q) {
  detail::write_numbers<detail::vector_of::q>(s, q, "q");
}
template <indexable X>
void set_velocities(runtime_state& s, const X& v) {
  detail::write_numbers<detail::vector_of::v>(s, v, "v");
}
template <indexable X>
void set_accelerations(runtime_state& s, const X& a) {
  detail::write_numbers<detail::vector_of::a>(s, a, "a");
}

}  // namespace kte
