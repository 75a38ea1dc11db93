#pragma once

#include <kte/dynamics/arguments/diagnose.hpp>
#include <kte/dynamics/arguments/state_numbers.hpp>
#include <kte/runtime_chain/runtime_state.hpp>

/// The numbers of a runtime state as vectors, and errors that name a number of it.
namespace kte {

/// A vector of numbers of a runtime chain.
template <class S>
using runtime_vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
/// A matrix of a runtime chain, dofs x dofs or another dynamic size.
template <class S>
using runtime_matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

namespace detail {
template <indexable X>
Eigen::VectorXd as_vector(const X& x, int n) {
  Eigen::VectorXd all(n);
  for (int i = 0; i < n; ++i) all[i] = static_cast<double>(x[static_cast<std::size_t>(i)]);
  return all;
}
template <vector_of Which, class S>
runtime_vector<S> read_numbers(const basic_runtime_state<S>& s) {
  runtime_vector<S> x(Which == vector_of::q ? s.nq() : s.dofs());
  read_listed_numbers<Which>(s, x);
  return x;
}
template <vector_of Which, class S, indexable X>
void write_numbers(basic_runtime_state<S>& s, const X& x, const char* name) {
  if constexpr (Which == vector_of::q)
    check_configuration(s.nq(), s.dofs(), x);
  else
    check_size(static_cast<std::size_t>(s.dofs()), x, name);
  for_each_listed_freedom(s, [&x](auto& c, const freedom& at) { put<Which>(c, at, x); });
}
template <class S>
std::vector<layout_entry<>> layout_of_state(const basic_runtime_state<S>& s) {
  std::vector<layout_entry<>> layout;
  for (const auto& f : s.freedoms())
    layout.push_back({s.made_for()->names[static_cast<std::size_t>(f.what)][static_cast<std::size_t>(f.slot)], f.what,
                      f.q, nq_of(f.what), f.v, nv_of(f.what)});
  return layout;
}
/// Throws `bad_argument`, naming the external signal, if an external signal is not finite.
template <class S>
[[gnu::cold]] void diagnose_signals(const char* what, const basic_runtime_state<S>& s) {
  for (const auto& signal : s.made_for()->signals) {
    const auto& name =
        s.made_for()->names[static_cast<std::size_t>(signal.what)][static_cast<std::size_t>(signal.slot)];
    if (signal.what == kind::vector)
      raise_if_signal_is_non_finite(what, name, s.template get<kind::vector>(signal.slot));
    else
      raise_if_signal_is_non_finite(what, name, s.template get<kind::input>(signal.slot));
  }
}
/// Throws `bad_argument`, naming the first number that is not finite, in the state or in `tau`.
template <class S>
[[noreturn, gnu::cold]] void diagnose(const char* what, const basic_runtime_state<S>& s,
                                      const runtime_vector<S>& tau = {}) {
  const auto layout = layout_of_state(s);
  const auto q = plain_numbers(read_numbers<vector_of::q>(s)), v = plain_numbers(read_numbers<vector_of::v>(s)),
             a = plain_numbers(read_numbers<vector_of::a>(s)), f = plain_numbers(tau);
  if (has_plain_numbers<S>) raise_if_no_rotation(layout, q);
  diagnose_signals(what, s);
  if (tau.size() == 0) raise_not_finite(what, layout, {{"q", q, true}, {"v", v}, {"a", a}});
  // Under forces, accelerations are arguments of hybrid dynamics only.
  if (!culprit(layout, {{"q", q, true}, {"v", v}, {"tau", f}}).empty())
    raise_not_finite(what, layout, {{"q", q, true}, {"v", v}, {"tau", f}});
  raise_not_finite(what, layout, {{"a", a}});
}
/// A function object that calls `diagnose` for a result.
template <class S>
struct diagnose_state {
  const char* what;
  const basic_runtime_state<S>& state;
  [[noreturn, gnu::cold]] void operator()() const { diagnose(what, state); }
};
template <class S>
diagnose_state(const char*, const basic_runtime_state<S>&) -> diagnose_state<S>;
/// Throws `singular_mass_matrix` for the mass of coordinate `row`.
template <class S>
[[noreturn, gnu::cold]] void diagnose_mass(const basic_runtime_state<S>& s, int row, bool finite) {
  const auto q = plain_numbers(read_numbers<vector_of::q>(s));
  raise_unusable_mass(layout_of_state(s), row, finite, q);
}
}  // namespace detail

#ifdef KTE_EXTERN
namespace detail {
/// Makes linking fail if the library was compiled with another alignment (-march), because memory that it allocates
/// could then not be freed. If linking fails here, use the same options for library and program.
template <int Alignment>
void compiled_for_alignment() {}
KTE_EXTERN template void compiled_for_alignment<EIGEN_MAX_ALIGN_BYTES>();
[[gnu::used]] inline void (*const same_alignment)() = compiled_for_alignment<EIGEN_MAX_ALIGN_BYTES>;

KTE_EXTERN template void diagnose(const char*, const runtime_state&, const runtime_vector<double>&);
KTE_EXTERN template void diagnose_mass(const runtime_state&, int, bool);
}  // namespace detail
#endif

}  // namespace kte
