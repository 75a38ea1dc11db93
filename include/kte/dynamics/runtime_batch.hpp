#pragma once

#include <kte/dynamics/batch.hpp>
#include <kte/dynamics/detail/runtime_batch.hpp>

/// Any number of states of a runtime chain of joints, links and bodies, W at once in the lanes of packs, in all as on
/// static chains (dynamics/batch.hpp). Results of a state do not depend on the others; each task of an executor has a
/// state of its own. Throws also `bad_argument` for chains of which elements have laws of their own.
namespace kte::batch {

template <int W = 0, class Q, class V, class A, class Tau, class Executor = in_this_thread,
          class P = detail::pack_of<detail::number_in<Q>, W, 1>>
void inverse_dynamics(const kte_map_chain& chain, const Q& q, const V& v, const A& a, Tau&& tau,
                      Executor&& executor = {}) {
  const auto nq = static_cast<std::size_t>(chain.nq()), nv = static_cast<std::size_t>(chain.dofs());
  const std::size_t n = detail::states_in(q, nq, "q");
  detail::check(v, nv, n, "v"), detail::check(a, nv, n, "a"), detail::check(tau, nv, n, "tau");
  detail::runtime_job<detail::runtime_inverse_dynamics, P, 3> job(chain, n, tau.data(), nv,
                                                                  {{{q.data(), nq}, {v.data(), nv}, {a.data(), nv}}});
  detail::finish(job, executor);
}

template <int W = 0, class Q, class V, class Tau, class A, class Executor = in_this_thread,
          class P = detail::pack_of<detail::number_in<Q>, W, 2>>
void forward_dynamics(const kte_map_chain& chain, const Q& q, const V& v, const Tau& tau, A&& a,
                      Executor&& executor = {}) {
  const auto nq = static_cast<std::size_t>(chain.nq()), nv = static_cast<std::size_t>(chain.dofs());
  const std::size_t n = detail::states_in(q, nq, "q");
  detail::check(v, nv, n, "v"), detail::check(tau, nv, n, "tau"), detail::check(a, nv, n, "a");
  detail::runtime_job<detail::runtime_forward_dynamics, P, 3> job(chain, n, a.data(), nv,
                                                                  {{{q.data(), nq}, {v.data(), nv}, {tau.data(), nv}}});
  detail::finish(job, executor);
}

template <int W = 0, class Q, class M, class Executor = in_this_thread,
          class P = detail::pack_of<detail::number_in<Q>, W, 1>>
void mass_matrix(const kte_map_chain& chain, const Q& q, M&& m, Executor&& executor = {}) {
  const auto nq = static_cast<std::size_t>(chain.nq()), nv = static_cast<std::size_t>(chain.dofs());
  const std::size_t n = detail::states_in(q, nq, "q");
  detail::check(m, nv * nv, n, "M", nv);
  detail::runtime_job<detail::runtime_mass_matrix, P, 1> job(chain, n, m.data(), nv * nv, {{{q.data(), nq}}});
  detail::finish(job, executor);
}

}  // namespace kte::batch
