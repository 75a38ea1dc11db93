#include "batch.hpp"

#include <kte/dynamics/batch.hpp>

#include <span>

#include "chain.hpp"

namespace kte_python {

namespace {
using numbers_in = std::span<const double>;
using numbers_out = std::span<double>;
std::size_t nq(const kte::runtime_chain& c) { return static_cast<std::size_t>(c.nq()); }
std::size_t nv(const kte::runtime_chain& c) { return static_cast<std::size_t>(c.dofs()); }
}  // namespace

bool can_be_in_packs(const kte::runtime_chain& c) {
  if (c.dofs() == 0) return false;
  try {
    kte::detail::refuse_loops(c);
    (void)c.make_state<kte::batch::detail::pack_of<double, 0, 1>>();
  } catch (const kte::error&) {
    return false;
  }
  return true;
}
bool chain_object::has_packs() const {
  if (has_packs_ < 0) has_packs_ = can_be_in_packs(chain_) ? 1 : 0;
  return has_packs_ == 1;
}

void inverse_dynamics_in_packs(const kte::runtime_chain& c, std::size_t n, const std::vector<const double*>& in,
                               double* tau, const interruptible_threads& team) {
  kte::batch::inverse_dynamics(c, numbers_in(in[0], n * nq(c)), numbers_in(in[1], n * nv(c)),
                               numbers_in(in[2], n * nv(c)), numbers_out(tau, n * nv(c)), team);
}
void forward_dynamics_in_packs(const kte::runtime_chain& c, std::size_t n, const std::vector<const double*>& in,
                               double* a, const interruptible_threads& team) {
  kte::batch::forward_dynamics(c, numbers_in(in[0], n * nq(c)), numbers_in(in[1], n * nv(c)),
                               numbers_in(in[2], n * nv(c)), numbers_out(a, n * nv(c)), team);
}
void mass_matrix_in_packs(const kte::runtime_chain& c, std::size_t n, const std::vector<const double*>& in, double* m,
                          const interruptible_threads& team) {
  kte::batch::mass_matrix(c, numbers_in(in[0], n * nq(c)), numbers_out(m, n * nv(c) * nv(c)), team);
}

}  // namespace kte_python
