#ifndef KTE_HYBRID_DYNAMICS_HPP
#define KTE_HYBRID_DYNAMICS_HPP

#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>

namespace kte {

/// The coordinates with prescribed accelerations, an argument of `hybrid_dynamics`.
template <key_type... Keys>
struct prescribed_coordinates {};
/// Names the degrees of freedom of a static chain whose accelerations are prescribed.
template <key_type... Keys>
[[nodiscard]] constexpr prescribed_coordinates<Keys...> prescribed(const Keys&...) {
  return {};
}

/// Result of `hybrid_dynamics`: all accelerations a and generalized forces tau.
template <class S, int N>
struct hybrid_dynamics_result {
  joint_vector<S, N> a, tau;
};

namespace detail {
/// The accelerations of some coordinates; all others are typed zeros.
template <class S, class Wiring, class V, class... Keys>
struct some_accelerations {
  const V& known;
  static constexpr auto is_known = [] {
    std::array<bool, std::size_t{Wiring::dofs} + 1> x{};
    [[maybe_unused]] const auto add = [&x]<class Key>(std::type_identity<Key>) {
      constexpr int slot = Wiring::template find<Key>();
      static_assert(is_coordinate(Key::what) && slot >= 0, "kte: this chain has no coordinate of this name");
      constexpr freedom at = Wiring::freedom_of(Key::what, slot);
      static_assert(slot < 0 || at.what == Key::what,
                    "kte: this coordinate is not a degree of freedom: its motion is prescribed");
      for (int i = 0; i < nv_of(at.what); ++i) x[static_cast<std::size_t>(at.v + i)] = true;
      return 0;
    };
    const int done[]{add(std::type_identity<Keys>{})..., 0};
    (void)done;
    return x;
  }();
  template <int I>
  KTE_INLINE auto at() const {
    if constexpr (is_known[I]) {
      return S(known[static_cast<std::size_t>(I)]);
    } else {
      return zero;
    }
  }
};
/// Hybrid dynamics of chains with closures: kte/loops.hpp.
template <class Chain>
struct static_hybrid;
}  // namespace detail

/// Accelerations and forces of a chain in which some coordinates have prescribed accelerations and the others known
/// forces (Featherstone, Rigid Body Dynamics Algorithms, 2008, section 9.2). `known` has dofs numbers: accelerations
/// for prescribed coordinates, applied forces (as tau of `forward_dynamics`) for the others.
///
///   const auto r = kte::hybrid_dynamics(arm, q, v, known, kte::prescribed(shoulder, elbow));      // static
///   const auto r = kte::hybrid_dynamics(arm, s, q, v, known, {"shoulder", "elbow"});              // runtime
///
/// The articulated-body algorithm computes the unknown accelerations, with prescribed joints as moving links. If
/// coordinates follow others, or two joints share one, it is replaced by a factorization of the rows of M that belong
/// to the unknown accelerations. Inverse dynamics then gives the forces. Returns a value. Other arguments and errors
/// are those of `forward_dynamics`. A name that is not a degree of freedom throws `bad_argument` or `unknown_name`.
template <class Gravity, class... E, indexable Q, indexable V, indexable X, key_type... Keys>
[[nodiscard]] auto hybrid_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const X& known,
                                   [[maybe_unused]] prescribed_coordinates<Keys...> prescribed) {
  using chain_type = static_chain<Gravity, E...>;
  if constexpr (detail::has_closures<chain_type>) {
    return detail::static_hybrid<chain_type>::dynamics(c, q, v, known, prescribed);
  } else {
    using wiring = typename chain_type::wiring;
    using S = value_of<Q>;
    static_assert(sizeof(detail::check_contacts_of<chain_type>) > 0);
    detail::check_configuration<chain_type>(q);
    check_size<chain_type::dofs>(v, "v"), check_size<chain_type::dofs>(known, "known");
    using accelerations = detail::some_accelerations<S, wiring, X, Keys...>;
    const detail::configuration<S, wiring, Q> at(q);
    at.check();
    using vector = joint_vector<S, chain_type::dofs>;
    hybrid_dynamics_result<S, chain_type::dofs> r;
    vector force;
    for (int i = 0; i < chain_type::dofs; ++i)
      force[i] = accelerations::is_known[static_cast<std::size_t>(i)] ? S(0) : S(known[static_cast<std::size_t>(i)]);
    const auto base = detail::base_under_gravity(c);
    using base_type = std::remove_const_t<decltype(base)>;
    using given_type = detail::given<decltype(at), detail::each<S, V>, accelerations, base_type, true>;
    const given_type g{at, {v}, {known}, base};
    if constexpr (detail::is_tree_of_joints<chain_type> || !chain_type::common) {
      static_assert(sizeof(detail::check_loads_of<chain_type>) > 0);
      if constexpr (detail::is_unrolled<chain_type, S>)
        detail::articulated_chain<S, chain_type, given_type>(c, g).accelerate(force, r.a);
      else
        r.a = detail::accelerations_by_tree<S>(c, g, force);
    } else {
      using at_rest = detail::same<zero_t>;
      r.a = force -
            detail::generalized_forces<S>(c, detail::given{at, detail::each<S, V>{v}, at_rest{}, base}, minus_one);
      for (int i = 0; i < chain_type::dofs; ++i)
        if (accelerations::is_known[static_cast<std::size_t>(i)]) r.a[i] = S(known[static_cast<std::size_t>(i)]);
      auto m = detail::mass_matrix_at<S>(c, at, base);
      detail::solve_partly_known(m, r.a, accelerations::is_known,
                                 [&at](int row) { detail::diagnose_mass<wiring>(row, true, at.q); });
      detail::check_accelerations<wiring>(r.a, g, force);
    }
    r.tau = detail::generalized_forces<S>(
        c, detail::given{at, detail::each<S, V>{v}, detail::each<S, vector>{r.a}, base}, minus_one);
    for (int i = 0; i < chain_type::dofs; ++i)  // given numbers are returned unchanged
      if (!accelerations::is_known[static_cast<std::size_t>(i)]) r.tau[i] = force[i];
    return r;
  }
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_HYBRID_DYNAMICS_OF_RUNTIME_CHAINS)
#define KTE_HYBRID_DYNAMICS_OF_RUNTIME_CHAINS

#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/runtime/accelerations.hpp>

#include <string_view>
#include <vector>

namespace kte {

namespace detail {
/// Accelerations and forces of a chain with loops; kte/loops.hpp sets it (dynamics/closed_loops/hybrid.hpp).
inline Eigen::VectorXd (*hybrid_accelerations_on_loops)(const runtime_chain&, runtime_state&, const std::vector<char>&,
                                                        const Eigen::VectorXd&, Eigen::VectorXd&) = nullptr;
#ifdef KTE_EXTERN
/// In kte::compiled.
Eigen::VectorXd hybrid_on_loops(const runtime_chain&, runtime_state&, const std::vector<char>&, const Eigen::VectorXd&,
                                Eigen::VectorXd&);
#  ifdef KTE_FUNCTION
inline const bool hybrid_dynamics_knows_loops = (hybrid_accelerations_on_loops = hybrid_on_loops, true);
#  endif
#endif
}  // namespace detail

template <class S, indexable Q, indexable V, indexable X>
hybrid_dynamics_result<S, Eigen::Dynamic> hybrid_dynamics(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q,
                                                          const V& v, const X& known,
                                                          const std::vector<std::string_view>& prescribed) {
  using namespace detail;
  check_regular_tree(c, s), refuse_contacts(c);
  if (!std::is_same_v<S, double> || hybrid_accelerations_on_loops == nullptr)
    refuse_loops(c, ": with numbers in double, and #include <kte/loops.hpp>, it does");
  const auto n = static_cast<std::size_t>(s.dofs());
  check_size(n, known, "known");
  std::vector<char> is_known(n, 0);
  for (const auto& name : prescribed) {
    const kind k = c.wiring().kind_of(name, false);
    const int slot = c.wiring().find(name, k);
    const auto at = std::find_if(s.freedoms().begin(), s.freedoms().end(),
                                 [&](const freedom& f) { return f.what == k && f.slot == slot; });
    if (at == s.freedoms().end())
      throw bad_argument("kte: '" + std::string(name) + "' is not a degree of freedom of this chain");
    for (int i = 0; i < nv_of(k); ++i) is_known[static_cast<std::size_t>(at->v + i)] = 1;
  }
  runtime_vector<S> given = runtime_vector<S>::Zero(s.dofs()), force = given;
  for (std::size_t i = 0; i < n; ++i)
    (is_known[i] ? given : force)[static_cast<Eigen::Index>(i)] = static_cast<S>(known[i]);
  return take(c, s, q, v, given, force).call([&] {
    hybrid_dynamics_result<S, Eigen::Dynamic> r;
    if constexpr (std::is_same_v<S, double>)
      if (has_loops(c)) [[unlikely]] {
        r.tau = force;
        r.a = hybrid_accelerations_on_loops(c, s, is_known, given, r.tau);
        return r;
      }
    if constexpr (std::is_same_v<S, double>) general_dynamics<runtime_state>::bring();  // for parts of joints
    keep_forces(s, [&force](int i) { return force[i]; });
    r.a = accelerations_at_state(c, s, is_known);
    r.tau = inverse_dynamics(c, s);
    for (std::size_t i = 0; i < n; ++i)  // given numbers are returned unchanged
      if (!is_known[i]) r.tau[static_cast<Eigen::Index>(i)] = force[static_cast<Eigen::Index>(i)];
    return r;
  });
}

}  // namespace kte

#endif
