#pragma once

#include <kte/dynamics/closed_loops/actuated_forces.hpp>
#include <kte/dynamics/closed_loops/static_closures.hpp>
#include <kte/dynamics/unrolled/arguments.hpp>

/// Closed loops of static chains: the algorithms of runtime chains on memory that the chain keeps.
namespace kte {

/// The closures of a static chain in a result, by key.
template <class Chain>
struct static_loop_results {
  /// By slot.
  std::array<loop_state<>, static_cast<std::size_t>(Chain::wiring::count(kind::loop))> loops;

  /// The forces and residuals of a closure.
  template <key_type Key>
  const loop_state<>& loop(const Key&) const {
    constexpr int slot = Key::what == kind::loop ? Chain::wiring::template find<Key>() : -1;
    static_assert(slot >= 0, "kte: this chain has no closure of this name (loop_key)");
    return loops[slot < 0 ? 0 : std::size_t{slot}];
  }
  /// The force of a closure, N, in axes of its first frame.
  template <key_type Key>
  const vec3<>& force(const Key& key) const {
    return loop(key).force;
  }
};
/// The result of `constrained_dynamics` of a static chain.
template <class Chain>
struct static_constrained_dynamics_result : static_loop_results<Chain> {
  joint_vector<double, Chain::dofs> a;  ///< accelerations
  int rank = 0, mobility = 0;           ///< number of independent rows of closures; dofs - rank
  double gap = 0;                       ///< the largest residual, m or rad: above rounding, q is off the loops
  std::vector<std::string> dependent;   ///< redundant rows, which have no force
};

namespace detail {
/// Calls f(closures, state with its loops) at the given quantities.
template <class Chain, class Given, class F>
decltype(auto) with_loops(const Chain& c, const Given& g, const F& f) {
  auto lent = c.kept.template borrow<static_loop_state<Chain>>(c);
  static_loop_state<Chain>& s = lent;
  s.take(g), check_regular(c, s);
  return f(static_closures<Chain, Given>{{c, g}}, s);
}
template <class Chain, class Q, class V, class A, class F>
decltype(auto) with_loops_at(const Chain& c, const Q& q, const V& v, const A& a, const F& f) {
  static_assert(std::is_convertible_v<value_of<Q>, double>, "kte: closed loops are computed in double");
  check_configuration<Chain>(q);
  const configuration<double, typename Chain::wiring, Q> at(q);
  at.check();
  return with_loops(c, given{at, v, a, base_under_gravity(c)}, f);
}

template <class Gravity, class... E>
struct static_loops<static_chain<Gravity, E...>> {
  using chain_type = static_chain<Gravity, E...>;
  using wiring = typename chain_type::wiring;
  using vector = joint_vector<double, chain_type::dofs>;

  template <class S, class Given>
  static vector accelerations(const chain_type& c, const Given& g, const vector& tau) {
    static_assert(std::is_same_v<S, double>, "kte: closed loops are computed in double");
    return with_loops(c, g, [&](const auto& closures, auto& s) -> vector {
      accelerate(closures, s, g, tau);
      refuse_unassembled(closures, s.loops.equations);
      return s.work.forces;
    });
  }
  template <class Closures, class State, class Given>
  static void accelerate(const Closures& closures, State& s, const Given& g, const vector& tau,
                         const loop_factor* rows = nullptr) {
    accelerate_on_loops(closures, s, s.loops, tree::given_forces(tau.data()), rows);
    check_accelerations<wiring>(vector(s.work.forces), g, tau);
  }
};
/// The degrees of freedom of coordinates, by name. Raises `unknown_name`.
template <class Chain>
std::vector<int> rows_of_coordinates(const Chain&, const std::vector<std::string>& names) {
  std::vector<int> rows;
  for (const auto& name : names) {
    const auto& table = layout_of_wiring<typename Chain::wiring>::table;
    const auto at = std::find_if(table.begin(), table.end(), [&name](const auto& x) { return x.name == name; });
    if (at == table.end()) raise<unknown_name>("kte: '" + name + "' is not a degree of freedom of this chain");
    for (int i = 0; i < at->nv; ++i) rows.push_back(at->v + i);
  }
  return rows;
}
template <class Chain, class Closures, class State>
auto result_of(const Closures& closures, const State& s) {
  static_constrained_dynamics_result<Chain> r;
  const auto& m = s.loops;
  r.a = s.work.forces;
  r.rank = m.factor.rank(), r.mobility = Chain::dofs - r.rank, r.gap = widest_gap(m.equations).size;
  r.dependent = dependent_rows(closures, m.equations, m.factor);
  for (const auto& x : m.equations.places.closures) {
    auto& loop = r.loops[static_cast<std::size_t>(x.loop)];
    loop = s.template get<kind::loop>(x.loop);
    for (int k = 0; k < x.rows.count(); ++k)
      row_of(loop.residual, loop.ang_residual, x.rows, k) =
          m.equations.residual[x.first + k] / m.equations.places.scale(x, k);
  }
  return r;
}
using not_moving = same<zero_t>;
}  // namespace detail

/// As for runtime chains; r.loop(pin).force, or r.force(pin).
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] auto constrained_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  static_assert(sizeof(detail::check_contacts_of<chain_type>) > 0);
  check_size<chain_type::dofs>(v, "v"), check_size<chain_type::dofs>(tau, "tau");
  joint_vector<double, chain_type::dofs> f;
  for (int i = 0; i < chain_type::dofs; ++i) f[i] = static_cast<double>(tau[static_cast<std::size_t>(i)]);
  return detail::with_loops_at(c, q, detail::each<double, V>{v}, detail::not_moving{},
                               [&](const auto& closures, auto& s) {
                                 detail::static_loops<chain_type>::accelerate(closures, s, closures.given, f);
                                 return detail::result_of<chain_type>(closures, s);
                               });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] loops_report loops(const static_chain<Gravity, E...>& c, const Q& q) {
  return detail::with_loops_at(c, q, detail::not_moving{}, detail::not_moving{}, [](const auto& closures, auto& s) {
    detail::factorize_loops(closures, s, s.loops);
    return detail::report_of(closures, s.loops, s.dofs());
  });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::MatrixXd loop_jacobian(const static_chain<Gravity, E...>& c, const Q& q) {
  return detail::with_loops_at(c, q, detail::not_moving{}, detail::not_moving{}, [](const auto& closures, auto& s) {
    s.loops.equations.at_positions(closures, s, true);
    detail::check_residuals(closures, s.loops.equations, true);
    return s.loops.equations.dense_jacobian();
  });
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto consistent_velocities(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using chain_type = static_chain<Gravity, E...>;
  detail::check_velocities<chain_type>(v);
  using vector = joint_vector<double, chain_type::dofs>;
  return detail::with_loops_at(c, q, detail::each<double, V>{v}, detail::not_moving{},
                               [&](const auto& closures, auto& s) -> vector {
                                 Eigen::VectorXd on(chain_type::dofs);
                                 for (int i = 0; i < chain_type::dofs; ++i)
                                   on[i] = static_cast<double>(v[static_cast<std::size_t>(i)]);
                                 detail::factorize_loops(closures, s, s.loops);
                                 detail::put_on_loops(closures, s, s.loops, on);
                                 detail::check_velocities_on_loops(on);
                                 return on;
                               });
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto impulse(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  return consistent_velocities(c, q, v);
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto assemble(const static_chain<Gravity, E...>& c, const Q& guess, const held_coordinates& held = {}) {
  using chain_type = static_chain<Gravity, E...>;
  using vector = joint_vector<double, chain_type::nq>;
  return detail::with_loops_at(
      c, guess, detail::not_moving{}, detail::not_moving{}, [&](const auto& closures, auto& s) -> vector {
        Eigen::VectorXd q(chain_type::nq);
        for (int i = 0; i < chain_type::nq; ++i) q[i] = static_cast<double>(guess[static_cast<std::size_t>(i)]);
        const auto set = [&](const Eigen::VectorXd& x) {
          const detail::configuration<double, typename chain_type::wiring, Eigen::VectorXd> at(x);
          s.take(detail::given{at, detail::not_moving{}, detail::not_moving{}, detail::base_under_gravity(c)});
        };
        const auto moved = [&](const Eigen::VectorXd& from, const Eigen::VectorXd& d) -> Eigen::VectorXd {
          return integrate(c, from, d, 1.0);
        };
        return detail::assembly(closures, s, s.loops.equations, detail::rows_of_coordinates(c, held.names), set, moved)
            .from(std::move(q));
      });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::MatrixXd loop_motion(const static_chain<Gravity, E...>& c, const Q& q,
                                          const actuated_coordinates& by) {
  return detail::with_loops_at(c, q, detail::not_moving{}, detail::not_moving{}, [&](const auto& closures, auto& s) {
    detail::refuse_repeated(by.names);
    detail::factorize_loops(closures, s, s.loops);
    return detail::motion_by(detail::rows_of_coordinates(c, by.names), s.dofs(), &s.loops);
  });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
[[nodiscard]] Eigen::VectorXd inverse_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a,
                                               const actuated_coordinates& by) {
  using chain_type = static_chain<Gravity, E...>;
  static_assert(sizeof(detail::check_contacts_of<chain_type>) > 0);
  detail::check_velocities<chain_type>(v), detail::check_rates<chain_type>(a, "a", "an acceleration");
  return detail::with_loops_at(
      c, q, detail::each<double, V>{v}, detail::each<double, A>{a},
      [&](const auto& closures, auto& s) -> Eigen::VectorXd {
        detail::refuse_repeated(by.names);
        detail::factorize_loops(closures, s, s.loops);
        const Eigen::MatrixXd g = detail::motion_by(detail::rows_of_coordinates(c, by.names), s.dofs(), &s.loops);
        detail::check_accelerations_on_loops(closures, s, s.loops.equations);
        const joint_vector<double, chain_type::dofs> f = detail::take_forces(c, closures.given, s, minus_one);
        return g.transpose() * f;
      });
}

}  // namespace kte
