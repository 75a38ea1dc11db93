#pragma once

#include <kte/dynamics/momentum.hpp>
#include <kte/models/state_space.hpp>

/// Generalized momenta of a chain, for variational integrators.
namespace kte::detail {

/// Momenta of a static chain. Arguments are not stored.
template <class Chain, class S>
class momenta_of {
  using wiring = typename Chain::wiring;
  using vector = joint_vector<S, sizes_of_model<Chain>::v>;
  static_assert(wiring::count(kind::internal) == 0,
                "kte: variational integrators do not support internal states of elements");

 public:
  explicit momenta_of(const Chain&) {}

  /// p = M(q) v.
  vector at(const Chain& c, const S* q, const vector& v) const { return generalized_momenta(c, q, v); }
  /// p and its rate M_dot v along v.
  auto along(const Chain& c, const S* q, const vector& v) const { return generalized_momenta_along(c, q, v); }
  /// Replaces p by M(q)^-1 p. Throws `singular_mass_matrix`.
  void solve(const Chain& c, const S* q, vector& p) const {
    auto m = mass_matrix(c, q);
    solve_in_place(m, p,
                   [](int row) { raise_singular_mass_matrix(name_of_row(layout_of_wiring<wiring>::table, row)); });
  }
};

}  // namespace kte::detail
