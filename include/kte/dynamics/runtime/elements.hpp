#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/dynamics/looped/derivatives.hpp>
#include <kte/dynamics/looped/mass_matrix_inverse.hpp>
#include <kte/dynamics/runtime/arguments.hpp>
#include <kte/dynamics/runtime/element_by_lane.hpp>
#include <kte/runtime_chain/chain.hpp>
#include <kte/runtime_chain/general_dynamics.hpp>

#include <algorithm>

/// Access of the loops over body nodes to the elements of a runtime chain.
namespace kte::detail {

/// The elements come from the given chain, because the state may belong to another copy of it.
struct runtime_elements {
  const runtime_chain& chain;

  const topology::connection& connection(int e) const { return chain.wiring().elements[static_cast<std::size_t>(e)]; }
  const kte_element& element(int e) const { return *connection(e).element; }
  std::span<const port> ports(int e) const { return connection(e).ports; }
  int index(int e, std::size_t p) const { return connection(e).index[p]; }
  int written(int e) const { return connection(e).index.back(); }
  void move(int e, runtime_state& s) const { element(e).doMotion(s); }
  void push(int e, runtime_state& s) const { element(e).doForce(s); }
  void derive(int e, runtime_state& s) const { element(e).derive_forces(s); }
  void mass_loads(int e, runtime_state& s) const { element(e).mass_loads(s); }
  bool holds(int e, runtime_state& s) const { return element(e).holds(s); }
  double friction(int e, runtime_state& s, const tree::dense_wrench<double>& end) const {
    return element(e).friction(s, end);
  }
  tree::dense_pose<double> place_joint(int e, const double* q, joint_axis<double>* axes, bool second) const {
    return element(e).place_joint(q, axes, second);
  }
  void move(int e, derivative_state& s) const { element(e).derive_motion(s); }
  void push(int e, derivative_state& s) const { element(e).derive_force(s); }
  derivative_number friction(int e, derivative_state& s, const tree::dense_wrench<derivative_number>& end) const {
    return element(e).derive_friction(s, end);
  }
  /// Forward dynamics if the chain is no tree of joints (dynamics/runtime/general_dynamics.hpp).
  void accelerate_generally(runtime_state& s, const tree::given_forces<double>& tau, std::span<const char> prescribed,
                            bool tree) const;
  // Packs: lane by lane.
  template <class S>
  requires(is_pack<S>) void move(int e, basic_runtime_state<S>& s) const {
    by_lane(chain, e, s, [](const kte_element& x, runtime_state& one, std::size_t) { x.doMotion(one); });
  }
  template <class S>
  requires(is_pack<S>) void push(int e, basic_runtime_state<S>& s) const {
    by_lane(chain, e, s, [](const kte_element& x, runtime_state& one, std::size_t) { x.doForce(one); });
  }
  template <class S>
  requires(is_pack<S>) void mass_loads(int e, basic_runtime_state<S>& s) const {
    by_lane(chain, e, s, [](const kte_element& x, runtime_state& one, std::size_t) { x.mass_loads(one); });
  }
  template <class S>
  requires(is_pack<S>) S friction(int e, basic_runtime_state<S>& s, const tree::dense_wrench<S>& end)
  const { return friction_by_lane(chain, e, s, end); }
  template <class S>
  requires(is_pack<S>) tree::dense_pose<S> place_joint(int e, const S* q, joint_axis<S>* axes, bool second)
  const { return place_joint_by_lane(connection(e), q, axes, second); }
  template <class S>
  requires(is_pack<S>) void derive(int e, basic_runtime_state<S>&) const {
    throw bad_argument("kte: derivatives in packs support joints, links and bodies only, not " +
                       describe_element(element(e)));
  }
  // States of other scalars belong to chains whose elements need no further calls.
  template <class State>
  void move(int, State&) const {}
  template <class S>
  tree::dense_pose<S> place_joint(int, const S*, joint_axis<S>*, bool) const {
    return {};
  }
  template <class State>
  void push(int, State&) const {}
  template <class State>
  void derive(int, State&) const {}
  template <class State>
  void mass_loads(int, State&) const {}
  template <class State>
  bool holds(int, State&) const {
    return false;
  }
  template <class State, class Wrench>
  auto friction(int, State&, const Wrench&) const {
    return typename State::scalar(0);
  }
  template <class State>
  [[noreturn]] void diagnose_mass(const State& s, int row, bool finite) const {
    detail::diagnose_mass(s, row, finite);
  }
  template <class State>
  [[noreturn]] void diagnose_friction(const State& s, int row) const {
    raise_jammed(name_of_row(layout_of_state(s), row));
  }
};

/// Throws `bad_argument` unless the state belongs to this chain and the chain is not part of another.
template <class S>
void check_whole(const runtime_chain& c, const basic_runtime_state<S>& s) {
  (void)c.wiring();
  c.check(s);
}
template <class Exception>
[[noreturn, gnu::cold]] void refuse_chain(const runtime_chain& c, const Exception& x) {
  throw bad_argument("kte: only passes and inverse dynamics support this chain: " +
                     describe_element(runtime_elements{c}.element(x.element)) + x.why);
}
/// Whether a chain has closures of loops.
inline bool has_loops(const runtime_chain& c) { return c.wiring().count(kind::loop) > 0; }
/// Throws for a chain that only the passes support.
template <class S>
void check_regular_tree(const runtime_chain& c, const basic_runtime_state<S>& s) {
  check_whole(c, s);
  if (s.tree().irregular) [[unlikely]]
    refuse_chain(c, s.tree().irregular);
}
/// Whether a chain has contacts.
inline bool has_contacts(const runtime_chain& c) { return c.wiring().count(kind::contact) > 0; }
[[noreturn]] void refuse_first_contact(const runtime_chain& c);
[[noreturn]] void refuse_first_loop(const runtime_chain& c, const char* instead);
/// Throws `bad_argument`, naming the first contact, for a chain with contacts in an algorithm that does not support
/// them.
inline void refuse_contacts(const runtime_chain& c) {
  if (has_contacts(c)) [[unlikely]]
    refuse_first_contact(c);
}
/// Throws `bad_argument`, naming the first closure, for a chain with loops in an algorithm that does not support them.
inline void refuse_loops(const runtime_chain& c, const char* instead = "") {
  if (has_loops(c)) [[unlikely]]
    refuse_first_loop(c, instead);
}
#ifdef KTE_FUNCTION
[[noreturn]] KTE_FUNCTION void refuse_first_contact(const runtime_chain& c) {
  const auto& elements = c.wiring().elements;
  const auto first = std::find_if(elements.begin(), elements.end(), [](const auto& e) { return e.touches; });
  throw bad_argument("kte: this algorithm does not support contacts, as " + describe_element(*first->element) +
                     ": contact_dynamics computes motions with contact forces");
}
[[noreturn]] KTE_FUNCTION void refuse_first_loop(const runtime_chain& c, const char* instead) {
  const auto& elements = c.wiring().elements;
  const auto first = std::find_if(elements.begin(), elements.end(), [](const auto& e) { return e.closes; });
  throw bad_argument("kte: this algorithm does not know closures of loops, as " + describe_element(*first->element) +
                     instead);
}
#endif
/// `check_regular_tree`, and refuses closures of loops.
template <class S>
void check_regular(const runtime_chain& c, const basic_runtime_state<S>& s) {
  check_regular_tree(c, s);
  refuse_loops(c), refuse_contacts(c);
}
/// Throws for a chain whose motion only the passes support.
template <class S>
void check_motion(const runtime_chain& c, const basic_runtime_state<S>& s) {
  check_whole(c, s);
  if (s.tree().moves_unknown) [[unlikely]]
    refuse_chain(c, s.tree().moves_unknown);
}

/// The forces to apply, after `forces_on_coordinates` or the passes; checked.
template <class S>
const runtime_vector<S>& applied_forces(basic_runtime_state<S>& s) {
  take_generalized_forces(s);
  check_result(s, [&s] { diagnose("a force", s); });
  return s.work.forces;
}

#ifdef KTE_EXTERN
KTE_EXTERN template void check_whole(const runtime_chain&, const runtime_state&);
KTE_EXTERN template void check_regular_tree(const runtime_chain&, const runtime_state&);
KTE_EXTERN template void check_regular(const runtime_chain&, const runtime_state&);
KTE_EXTERN template void forces_on_coordinates(const runtime_elements&, runtime_state&, acting, bool, bool);
KTE_EXTERN template void mass_of_coordinates(const runtime_elements&, runtime_state&);
KTE_EXTERN template void take_generalized_forces(runtime_state&);
KTE_EXTERN template void place_bodies(const runtime_elements&, runtime_state&);
KTE_EXTERN template void place_in_world(runtime_state&);
KTE_EXTERN template void take_rates(runtime_state&);
KTE_EXTERN template void take_bases(runtime_state&);
#endif

}  // namespace kte::detail
