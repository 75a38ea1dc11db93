#ifndef KTE_BATCH_HPP
#define KTE_BATCH_HPP

#include <kte/dynamics/executors.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/packs/batch.hpp>

/// The algorithms on any number of states of a chain, W states at a time in the elements of packs. Runtime chains with
/// elements that may hold their coordinate throw `bad_argument`.
///
/// Arguments are arrays of float or double, all of one type, with data() and size() (vector, array, span, Eigen): one
/// state after the other, the n numbers of state k from k n on, as in an Eigen matrix with a column per state. Results
/// are written in this form; they may overwrite an input with as many numbers per state.
///
/// The result for a state does not depend on the other states, their number or order, or the executor: it is equal bit
/// for bit, for one W in one program. It differs from that for a single state by rounding.
///
/// Throws `bad_argument`, naming an argument of wrong size, before anything is written. States without a result (NaN,
/// infinity, a singular mass matrix) do not affect the others: all others are written, NaN is written for these, and
/// then the error of the first of them is thrown, with its number: the error that the algorithm throws for this state
/// alone, `bad_argument` or `singular_mass_matrix`.
///
/// By default W is the number of elements in one register of the CPU, in two for forward dynamics of static chains, to
/// hide the latency of its divisions and sums. Needs exceptions.
namespace kte::batch {

namespace detail {

template <class X>
using number_in = std::remove_cvref_t<decltype(*std::declval<X&>().data())>;

/// A pack of W lanes; by default as many as `Registers` registers hold.
template <class T, int W, int Registers>
using pack_of = pack<T, W == 0 ? Registers * kte::detail::widest_pack<T> : W>;

/// Numbers per state: nv degrees of freedom and nq positions, nq >= nv.
template <class Chain>
inline constexpr std::size_t nv = std::size_t{Chain::dofs};
template <class Chain>
inline constexpr std::size_t nq = nv<Chain>;
template <class Chain>
requires(requires { Chain::nq; }) inline constexpr std::size_t nq<Chain> = std::size_t{Chain::nq};

/// Rejects a matrix whose columns are not states: the column size must be that of a state, of `part` of one, or 1.
template <class X>
void check_layout(const X& x, std::size_t a_state, std::size_t part, const char* name) {
  if constexpr (requires { x.innerStride(), x.outerStride(), x.rows(); }) {
    static_assert(!X::IsRowMajor || X::IsVectorAtCompileTime, "kte: in a batch the states are the columns of a matrix");
    if (x.size() == 0) return;
    if (x.innerStride() != 1 || (!X::IsVectorAtCompileTime && x.outerStride() != x.rows()))
      kte::detail::raise<bad_argument>(std::string("kte: the numbers of ") + name + " do not lie side by side");
    const auto rows = static_cast<std::size_t>(x.rows());
    if (!X::IsVectorAtCompileTime && rows != a_state && rows != part && rows != 1)
      kte::detail::raise<bad_argument>(std::string("kte: ") + name + " has columns of " + std::to_string(x.rows()) +
                                       " numbers, a state has " + std::to_string(a_state));
  }
}
/// The number of states in x.
template <class X>
std::size_t states_in(const X& x, std::size_t a_state, const char* name) {
  check_layout(x, a_state, a_state, name);
  const auto size = static_cast<std::size_t>(x.size());
  if (a_state == 0 ? size != 0 : size % a_state != 0)
    kte::detail::raise<bad_argument>(std::string("kte: ") + name + " has " + std::to_string(size) +
                                     " numbers, a state has " + std::to_string(a_state));
  return a_state == 0 ? 0 : size / a_state;
}
template <class X>
void check(const X& x, std::size_t a_state, std::size_t count, const char* name, std::size_t part = 1) {
  check_layout(x, a_state, part, name);
  if (static_cast<std::size_t>(x.size()) != a_state * count)
    kte::detail::raise<bad_argument>(std::string("kte: ") + name + " has " + std::to_string(x.size()) + " numbers, " +
                                     std::to_string(count) + " states have " + std::to_string(a_state * count));
}

template <class Job, class Executor>
void finish(Job& job, Executor&& executor) {
  if (job.tasks() > 0) executor(job.tasks(), job);
  job.raise();
}

struct inverse_dynamics_of {
  template <class Chain, class Q, class V>
  KTE_INLINE auto operator()(const Chain& c, const Q& q, const V& v, const V& a) const {
    return kte::inverse_dynamics(c, q, v, a);
  }
};
struct forward_dynamics_of {
  template <class Chain, class Q, class V>
  KTE_INLINE auto operator()(const Chain& c, const Q& q, const V& v, const V& tau) const {
    return kte::forward_dynamics(c, q, v, tau);
  }
};
struct mass_matrix_of {
  template <class Chain, class Q>
  KTE_INLINE auto operator()(const Chain& c, const Q& q) const {
    return kte::mass_matrix(c, q);
  }
};

}  // namespace detail

/// Generalized forces tau of q, v, a; see `kte::inverse_dynamics`.
template <int W = 0, class Chain, class Q, class V, class A, class Tau, class Executor = in_this_thread,
          class P = detail::pack_of<detail::number_in<Q>, W, 1>>
void inverse_dynamics(const Chain& chain, const Q& q, const V& v, const A& a, Tau&& tau, Executor&& executor = {}) {
  constexpr std::size_t nq = detail::nq<Chain>, nv = detail::nv<Chain>;
  const std::size_t n = detail::states_in(q, nq, "q");
  detail::check(v, nv, n, "v"), detail::check(a, nv, n, "a"), detail::check(tau, nv, n, "tau");
  detail::job<detail::inverse_dynamics_of, Chain, P, nv, nq, nv, nv> job(chain, n, tau.data(),
                                                                         {q.data(), v.data(), a.data()});
  detail::finish(job, executor);
}

/// Accelerations a of q, v, tau; see `kte::forward_dynamics`.
template <int W = 0, class Chain, class Q, class V, class Tau, class A, class Executor = in_this_thread,
          class P = detail::pack_of<detail::number_in<Q>, W, 2>>
void forward_dynamics(const Chain& chain, const Q& q, const V& v, const Tau& tau, A&& a, Executor&& executor = {}) {
  constexpr std::size_t nq = detail::nq<Chain>, nv = detail::nv<Chain>;
  const std::size_t n = detail::states_in(q, nq, "q");
  detail::check(v, nv, n, "v"), detail::check(tau, nv, n, "tau"), detail::check(a, nv, n, "a");
  detail::job<detail::forward_dynamics_of, Chain, P, nv, nq, nv, nv> job(chain, n, a.data(),
                                                                         {q.data(), v.data(), tau.data()});
  detail::finish(job, executor);
}

/// Mass matrices M of q, all n^2 numbers of each, in either storage order, because they are symmetric; see
/// `kte::mass_matrix`.
template <int W = 0, class Chain, class Q, class M, class Executor = in_this_thread,
          class P = detail::pack_of<detail::number_in<Q>, W, 1>>
void mass_matrix(const Chain& chain, const Q& q, M&& m, Executor&& executor = {}) {
  constexpr std::size_t nq = detail::nq<Chain>, nv = detail::nv<Chain>;
  const std::size_t n = detail::states_in(q, nq, "q");
  detail::check(m, nv * nv, n, "M", nv);
  detail::job<detail::mass_matrix_of, Chain, P, nv * nv, nq> job(chain, n, m.data(), {q.data()});
  detail::finish(job, executor);
}

}  // namespace kte::batch

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_BATCH_OF_RUNTIME_CHAINS)
#define KTE_BATCH_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/batch.hpp>

namespace kte::batch {

template <int W = 0, class Q, class V, class A, class Tau, class Executor = in_this_thread,
          class P = detail::pack_of<detail::number_in<Q>, W, 1>>
void inverse_dynamics(const runtime_chain& chain, const Q& q, const V& v, const A& a, Tau&& tau,
                      Executor&& executor = {}) {
  kte::detail::refuse_loops(chain), kte::detail::refuse_contacts(chain);
  const auto nq = static_cast<std::size_t>(chain.nq()), nv = static_cast<std::size_t>(chain.dofs());
  const std::size_t n = detail::states_in(q, nq, "q");
  detail::check(v, nv, n, "v"), detail::check(a, nv, n, "a"), detail::check(tau, nv, n, "tau");
  detail::runtime_job<detail::runtime_inverse_dynamics, P, 3> job(chain, n, tau.data(), nv,
                                                                  {{{q.data(), nq}, {v.data(), nv}, {a.data(), nv}}});
  detail::finish(job, executor);
}

template <int W = 0, class Q, class V, class Tau, class A, class Executor = in_this_thread,
          class P = detail::pack_of<detail::number_in<Q>, W, 1>>
void forward_dynamics(const runtime_chain& chain, const Q& q, const V& v, const Tau& tau, A&& a,
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
void mass_matrix(const runtime_chain& chain, const Q& q, M&& m, Executor&& executor = {}) {
  const auto nq = static_cast<std::size_t>(chain.nq()), nv = static_cast<std::size_t>(chain.dofs());
  const std::size_t n = detail::states_in(q, nq, "q");
  detail::check(m, nv * nv, n, "M", nv);
  detail::runtime_job<detail::runtime_mass_matrix, P, 1> job(chain, n, m.data(), nv * nv, {{{q.data(), nq}}});
  detail::finish(job, executor);
}

}  // namespace kte::batch

#endif
