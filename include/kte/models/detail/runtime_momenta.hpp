#pragma once

#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/models/detail/momenta.hpp>
#include <kte/models/unchanging_chain.hpp>
#include <kte/runtime_chain.hpp>

#include <utility>

namespace kte::detail {

/// Momenta of a runtime chain, in its own state.
template <class S>
class momenta_of<unchanging_chain, S> {
  using vector = runtime_vector<S>;
  using numbers = Eigen::Map<const vector>;

 public:
  explicit momenta_of(const unchanging_chain& c) : s_(c.make_state()) {
    refuse_loops(c), refuse_contacts(c);
    if (c.wiring().count(kind::internal) > 0)
      raise<bad_argument>(
          "kte: variational integrators do not support internal states of elements, as that of " +
          describe_element(*c.wiring().elements[static_cast<std::size_t>(c.wiring().keepers[0])].element));
  }

  vector at(const unchanging_chain& c, const S* q, const vector& v) {
    return mass_matrix(c, s_, numbers(q, s_.nq())) * v;
  }
  std::pair<vector, vector> along(const unchanging_chain& c, const S* q, const vector& v) {
    const vector rate = mass_matrix_rate(c, s_, numbers(q, s_.nq()), v) * v;
    return {mass_matrix(c, s_) * v, rate};
  }
  void solve(const unchanging_chain& c, const S* q, vector& p) {
    auto m = mass_matrix(c, s_, numbers(q, s_.nq()));
    solve_in_place(m, p, [this](int row) { diagnose_mass(s_, row, true); });
  }

 private:
  runtime_state s_;
};

}  // namespace kte::detail
