#pragma once

#include <kte/chain/runtime_state.hpp>
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
