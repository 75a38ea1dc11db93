#pragma once

#include <kte/contract/force_derivatives.hpp>
#include <kte/contract/varying_joint.hpp>
#include <kte/detail/no_value.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/dynamics/looped/derivatives.hpp>
#include <kte/dynamics/looped/mass_matrix_inverse.hpp>
#include <kte/dynamics/looped/static_state.hpp>
#include <kte/dynamics/unrolled/tree.hpp>

/// Algorithms on static chains that are not unrolled, by the loops over body nodes of runtime chains. `Given`:
/// dynamics/unrolled/given.hpp. The first call makes body nodes and memory, which chains too large to unroll keep; with
/// functions as scalars each call makes them.
namespace kte::detail {

template <class Core>
using inputs_of = std::make_index_sequence<input_count<Core>>;
template <class Core, class State>
auto passes_of(const Core& core, State& s, const int* index) {
  return stored_element<Core, State, by_index>{core, s, {index}};
}
/// What elements do in the loops over body nodes: one function for each type of core, whatever the number of elements
/// and the chain.
enum class element_step { move, push, mass_loads, derive };
template <element_step Step, class Core, class State>
[[gnu::noinline]] void step_of_core(const Core& core, State& s, const int* index) {
  if constexpr (Step == element_step::move)
    passes_of(core, s, index).motion(inputs_of<Core>{});
  else if constexpr (Step == element_step::push)
    passes_of(core, s, index).force(inputs_of<Core>{});
  else if constexpr (Step == element_step::mass_loads)
    passes_of(core, s, index).mass_force(inputs_of<Core>{});
  else
    subtract_force_derivatives(core, s, index);
}

/// The elements of a chain with an effect in a step, as an index_sequence.
template <class Chain, class Elements = std::make_index_sequence<Chain::size>>
struct acting_elements;
template <class Chain, std::size_t... E>
struct acting_elements<Chain, std::index_sequence<E...>>
    : numbers_where<std::array<bool, sizeof...(E) + 1>{acts<core_of<Chain, E>>...}> {};

template <element_step Step, std::size_t I, class Chain, class State>
void do_step(const Chain& c, State& s) {
  using wiring = typename Chain::wiring;
  step_of_core<Step>(c.template core<I>(), s, wiring::table.slot.data() + wiring::first[I]);
}
/// By number of the element.
template <element_step Step, class Chain, class State>
inline constexpr auto steps_of = [] {
  std::array<void (*)(const Chain&, State&), Chain::size> all{};
  unroll(typename acting_elements<Chain>::type{},
         [&all]<std::size_t I>() { all[I] = &do_step<Step, I, Chain, State>; });
  return all;
}();

/// The elements of a static chain for the loops over body nodes.
template <class Chain, class Given>
struct static_elements {
  const Chain& chain;
  const Given& given;  ///< named in messages
  using wiring = typename Chain::wiring;

  static std::span<const port> ports(int e) { return static_connections<Chain>{}.ports(static_cast<std::size_t>(e)); }
  static int index(int e, std::size_t p) { return wiring::slot(static_cast<std::size_t>(e), p); }
  static int written(int e) { return index(e, ports(e).size() - 1); }

  template <class State>
  void move(int e, State& s) const {
    run<element_step::move>(e, s);
  }
  template <class State>
  void push(int e, State& s) const {
    run<element_step::push>(e, s);
  }
  template <class State>
  void derive(int e, State& s) const {
    run<element_step::derive>(e, s);
  }
  // Used only by rare chains; not instantiated for others.
  template <class State>
  void mass_loads(int e, State& s) const {
    if constexpr (!Chain::common) run<element_step::mass_loads>(e, s);
  }
  template <class State>
  bool holds(int e, State& s) const {
    bool h = false;
    if constexpr (!Chain::common)
      with_core(e, [&]<std::size_t J>(const auto& core) {
        h = passes_of(core, s, wiring::table.slot.data() + wiring::first[J]).holds(inputs_of<core_of<Chain, J>>{});
      });
    return h;
  }
  template <class S>
  tree::dense_pose<S> place_joint(int e, const S* q, joint_axis<S>* axes, bool second) const {
    tree::dense_pose<S> at{};
    if constexpr (!Chain::common)
      with_core(e, [&]<std::size_t J>(const auto& core) {
        if constexpr (varying_axes<core_of<Chain, J>>) at = place_varying_joint(core, q, axes, second);
      });
    return at;
  }
  template <class State, class Wrench>
  auto friction(int e, State& s, const Wrench& end) const {
    typename State::scalar f(0);
    if constexpr (!Chain::common)
      with_core(e, [&]<std::size_t J>(const auto& core) {
        f = as<typename State::scalar>(passes_of(core, s, wiring::table.slot.data() + wiring::first[J]).friction(end));
      });
    return f;
  }
  template <class State>
  [[noreturn]] void diagnose_mass(const State&, int row, bool finite) const {
    detail::diagnose_mass<wiring>(row, finite, given.at.q);
  }
  template <class State>
  [[noreturn]] void diagnose_friction(const State&, int row) const {
    raise_jammed(name_of_row(layout_of_wiring<wiring>::table, row));
  }

 private:
  /// Calls f<e>(core of element e).
  template <class F>
  void with_core(int e, const F& f) const {
    unroll<Chain::size>([&]<std::size_t I>() {
      if (e == static_cast<int>(I)) f.template operator()<I>(chain.template core<I>());
    });
  }
  template <element_step Step, class State>
  void run(int e, State& s) const {
    steps_of<Step, Chain, State>[static_cast<std::size_t>(e)](chain, s);
  }
};
template <class Chain, class Given>
static_elements(const Chain&, const Given&) -> static_elements<Chain, Given>;

/// Whether a chain may have elements that only passes support.
template <class Chain>
inline constexpr bool may_need_passes = !Chain::common || !std::is_void_v<first_element<Chain, has_own_loads>>;

/// Throws `bad_argument` for elements that body nodes cannot represent.
template <class Chain, class State>
void check_regular(const Chain&, const State& s) {
  if (!s.tree().irregular) [[likely]]
    return;
  const auto name = []<std::size_t... I>(std::size_t i, std::index_sequence<I...>) {
    const std::string_view names[]{std::string_view(core_of<Chain, I>::type)...};
    return names[i];
  }
  (static_cast<std::size_t>(s.tree().irregular.element), std::make_index_sequence<Chain::size>{});
  raise<bad_argument>(std::string("kte: ").append(name).append(s.tree().irregular.why));
}

/// Inverse dynamics at the given quantities: the generalized forces on all degrees of freedom, times `sign`.
template <class Chain, class Given, class State, class Sign>
auto take_forces(const Chain& c, const Given& g, State& s, Sign sign) {
  s.take(g);
  const bool by_passes = may_need_passes<Chain> && s.tree().irregular;
  if constexpr (may_need_passes<Chain>)
    if (by_passes) c.doMotion(s), c.clearForce(s), c.doForce(s);
  if (!by_passes) {
    check_regular(c, s);
    // Without names for messages, so that there is one instance for all `Given`.
    forces_on_coordinates(static_elements<Chain, no_value>{c, {}}, s, acting::all);
  }
  joint_vector<typename State::scalar, Chain::dofs> f;
  read_listed_numbers<vector_of::f>(s, f);
  for (auto& x : f) x = as<typename State::scalar>(sign * x);
  return f;
}
template <class S, class Chain, class Given, class Sign>
auto forces_by_tree(const Chain& c, const Given& g, Sign sign) {
  auto lent = c.kept.template borrow<static_state<S, Chain>>(c);
  static_state<S, Chain>& s = lent;
  return take_forces(c, g, s, sign);
}

/// f(elements, state) of an algorithm that loops over body nodes; the state has the given quantities.
template <class S, class Chain, class Given, class F>
auto by_tree(const Chain& c, const Given& g, const F& f) {
  auto lent = c.kept.template borrow<static_state<S, Chain>>(c);
  static_state<S, Chain>& s = lent;
  s.take(g), check_regular(c, s);
  return f(static_elements{c, g}, s);
}
template <class S, class Chain, class Given>
joint_matrix<S, Chain::dofs> mass_by_tree(const Chain& c, const Given& g) {
  return by_tree<S>(c, g, [](const auto& elements, auto& s) -> joint_matrix<S, Chain::dofs> {
    mass_of_coordinates(elements, s);
    return s.work.mass;
  });
}

/// Accelerations under the forces `tau`. A degree of freedom whose acceleration is given (not a typed zero in `Given`)
/// keeps it.
template <class Chain, class Given, class State, class Tau>
void accelerate_static(const Chain& c, const Given& g, State& s, const Tau& tau) {
  static constexpr auto prescribed = []<int... I>(std::integer_sequence<int, I...>) {
    return std::array<char, sizeof...(I)>{
        !std::is_same_v<decltype(std::declval<const Given&>().a.template at<I>()), zero_t>...};
  }
  (std::make_integer_sequence<int, Chain::dofs>{});
  s.take(g), check_regular(c, s);
  accelerations_on_coordinates(static_elements{c, g}, s, tree::given_forces<typename State::scalar>(tau.data()),
                               prescribed);
  check_accelerations<typename Chain::wiring>(s.work.forces, g, tau);
}
template <class S, class Chain, class Given>
joint_vector<S, Chain::dofs> accelerations_by_tree(const Chain& c, const Given& g,
                                                   const joint_vector<S, Chain::dofs>& tau) {
  auto lent = c.kept.template borrow<static_state<S, Chain>>(c);
  static_state<S, Chain>& s = lent;
  accelerate_static(c, g, s, tau);
  return s.work.forces;
}
/// Forward dynamics and the inverse of the mass matrix.
template <class S, class Chain, class Given>
void accelerations_and_inverse_by_tree(const Chain& c, const Given& g, const joint_vector<S, Chain::dofs>& tau,
                                       joint_vector<S, Chain::dofs>& a, joint_matrix<S, Chain::dofs>& inverse) {
  auto lent = c.kept.template borrow<static_state<S, Chain>>(c);
  static_state<S, Chain>& s = lent;
  accelerate_static(c, g, s, tau);
  a = s.work.forces;
  if (s.tree().plan.tree && s.tree().locks.empty())
    invert_articulated(s, s.work.inverse);
  else
    invert_free_rows(static_elements{c, g}, s, s.work.inverse);
  inverse = s.work.inverse;
}
/// The derivatives of accelerations by forces, from dtau/da.
template <class S, class Chain, class Given>
void invert_by_tree(const Chain& c, const Given& g, const joint_matrix<S, Chain::dofs>& by_a,
                    joint_matrix<S, Chain::dofs>& inverse) {
  by_tree<S>(c, g, [&](const auto& elements, auto& s) { invert_free_rows_with_friction(elements, s, by_a, inverse); });
}
template <class S, class Chain, class Given>
joint_matrix<S, Chain::dofs> inverse_mass_by_tree(const Chain& c, const Given& g) {
  return by_tree<S>(c, g, [](const auto& elements, auto& s) -> joint_matrix<S, Chain::dofs> {
    articulate_and_invert(elements, s, s.work.inverse);
    return s.work.inverse;
  });
}

template <class S, class Chain, class Given, class Result>
void derivatives_by_tree(const Chain& c, const Given& g, Result& r) {
  auto lent = c.kept.template borrow<static_state<S, Chain>>(c);
  static_state<S, Chain>& s = lent;
  r.tau = take_forces(c, g, s, minus_one);
  derive_forces(static_elements{c, g}, s);
  r.by_q = s.work.of_forces.by_q, r.by_v = s.work.of_forces.by_v, r.by_a = s.work.of_forces.by_a;
}

}  // namespace kte::detail
