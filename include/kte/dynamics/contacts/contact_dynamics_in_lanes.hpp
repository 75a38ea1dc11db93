#pragma once

#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/contacts/contacts_in_lanes.hpp>

/// `contact_dynamics` of runtime chains that are trees, in packs S of states in double: recursions over bodies in
/// packs, surfaces state by state.
namespace kte {

namespace detail {

/// The memory of a state in packs for the contacts of its chain.
template <class S>
class runtime_contacts_in_lanes {
 public:
  std::shared_ptr<const char> layout;
  basic_contact_dynamics_result<S> result;

  runtime_contacts_in_lanes(const chain_constraints& c, const basic_runtime_state<S>& s)
      : layout(c.layout()), places_(c, s), all_(c, s, places_) {
    for (const auto& x : all_.contacts) result.names.push_back(c.loop_name(x.loop));
    result.contacts.resize(all_.contacts.size());
  }
  /// The contacts, with their rows and forces.
  contacts_in_lanes<S>& solver() { return all_; }
  /// Accelerations under applied(i), to `forces` of the working memory, and the result.
  void accelerate(const chain_constraints& c, basic_runtime_state<S>& s, const tree::given_forces<S>& applied) {
    const auto biases = articulate_under(c.elements(), s, applied, {});
    for (auto& x : all_.contacts) locate(c, s, x);
    all_.choose(c);
    for (auto& x : all_.contacts)
      if (x.touches) put_rows(s, x);
    for (std::size_t i = 0; i < all_.contacts.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        if (all_.contacts[i].touches && all_.contacts[j].touches) multiply(all_.contacts[i], all_.contacts[j]);
    all_.solve(c);
    for (const auto& x : all_.contacts)
      if (x.touches) push(s, x);
    accelerate_after(s, biases);
    result.several = all_.several;
    put_contacts_at(all_,
                    [this](int slot) -> contact_state<S>& { return result.contacts[static_cast<std::size_t>(slot)]; });
  }

 private:
  using contact = contact_in_lanes<S>;
  const closure_place& place(const contact& x) const { return places_.closures[static_cast<std::size_t>(x.closure)]; }
  /// The place of a contact, from bias motions in the working memory of the state.
  void locate(const chain_constraints& c, const basic_runtime_state<S>& s, contact& x) {
    const auto& at = place(x);
    auto& m = motions_[static_cast<std::size_t>(x.slot)];
    m = loop_equations::biased_motion_between(s, at);
    all_.put_place(c, x, [&](std::size_t lane) { return c.element(at.element).lane(lane).touch_at(lane_of(m, lane)); });
  }
  /// The effects of unit forces of contact x on axes, and `bias`.
  void put_rows(basic_runtime_state<S>& s, contact& x) {
    const auto& m = motions_[static_cast<std::size_t>(x.slot)];
    const auto to_body = transpose(m.rotation);
    const vec3<S> arm = x.place.point - m.position;
    const S unit(1 / all_.length);
    for (int k = 0; k < x.rows(); ++k) {
      const vec3<S> n = unit * x.basis[static_cast<std::size_t>(k)];
      std::size_t count = 0;
      tree::load_powers<S> sum;
      loop_equations::send_load<true>(
          s, place(x), m, tree::simd_wrench<S>{to_body * n, to_body * cross(arm, n)}, loads_,
          [&](int axis, const S& e) {
            if (count == x.path.size()) x.path.emplace_back();
            auto& to = x.path[count++];
            to.axis = axis, to.left[static_cast<std::size_t>(k)] = e;
            to.rate[static_cast<std::size_t>(k)] = s.work.factors[static_cast<std::size_t>(axis)].inverse * e;
          },
          sum);
      all_.bias[x.first + k] = dot(n, x.place.slip_rate) + sum.sum;
    }
    all_.bias[x.first] += unit * x.place.bending;
  }
  /// The block of W of two contacts.
  void multiply(const contact& x, const contact& y) {
    std::array<std::array<S, 3>, 3> sum{};
    auto a = x.path.rbegin();
    auto b = y.path.rbegin();
    while (a != x.path.rend() && b != y.path.rend()) {  // axes ascend from the bases
      if (a->axis != b->axis) {
        a->axis < b->axis ? ++a : ++b;
        continue;
      }
      for (int i = 0; i < x.rows(); ++i)
        for (int k = 0; k < y.rows(); ++k) at(sum, i, k) += at(a->left, i) * at(b->rate, k);
      ++a, ++b;
    }
    for (int i = 0; i < x.rows(); ++i)
      for (int k = 0; k < y.rows(); ++k)
        all_.w(x.first + i, y.first + k) = all_.w(y.first + k, x.first + i) = at(sum, i, k);
  }
  /// Adds the effect of the forces of contact x on the rates of axes.
  void push(basic_runtime_state<S>& s, const contact& x) const {
    for (const auto& to : x.path)
      for (int k = 0; k < x.rows(); ++k)
        s.work.factors[static_cast<std::size_t>(to.axis)].rate += at(to.rate, k) * all_.forces[x.first + k];
  }
  static auto& at(auto& x, int k) { return x[static_cast<std::size_t>(k)]; }
  static auto& at(auto& x, int i, int k) { return at(at(x, i), k); }

  closure_places places_;
  contacts_in_lanes<S> all_;
  std::vector<closing_motion<S>> motions_{all_.contacts.size()};  ///< of bodies at surfaces, by slot
  std::vector<tree::simd_wrench<S>> loads_;
};
template <class S>
runtime_contacts_in_lanes<S>& contacts_in_lanes_of(const runtime_chain& c, basic_runtime_state<S>& s) {
  const auto make = [&] { return runtime_contacts_in_lanes<S>(contacts_of(c), s); };
  auto& m = s.contacts.template get<runtime_contacts_in_lanes<S>>(make);
  if (m.layout != c.wiring().layout) m = make();
  return m;
}
/// Throws `bad_argument` for chains whose contacts packs do not support.
template <class S>
void check_contacts_in_packs(const runtime_chain& c, const basic_runtime_state<S>& s) {
  const std::string only = "kte: contact dynamics in packs: ";
  const auto& readers = s.tree().readers;
  if (has_loops(c)) throw bad_argument(only + "chains with closures of loops take single states");
  if (!readers.empty())
    throw bad_argument(only + describe_element(runtime_elements{c}.element(readers.front())) +
                       " has load-dependent friction, which chains with contacts do not know");
  if (!s.tree().plan.tree) throw bad_argument(only + "joints must not share coordinates");
}

}  // namespace detail

/// In packs S of states. Each lane has the result of its state alone, in other roundings: `r.a[0][lane]`,
/// `r.force("foot").y[lane]`, `mode_of(r.contact("foot"), lane)`. Lanes in which contacts stick where they are at rest,
/// and slide where they move, are solved together. Others, in which a contact at rest opens or begins to slide, and
/// plane problems of up to 3 contacts, are solved lane by lane. A lane that has no result refuses the call, with its
/// number. Chains with closures, and those where coordinates follow others, are refused.
template <class S, indexable Q, indexable V, indexable T>
requires(detail::has_lanes_of_double<S>) const basic_contact_dynamics_result<S>& contact_dynamics(
    const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v, const T& tau) {
  detail::check_regular_tree(c, s);
  detail::check_contacts_in_packs(c, s);
  return detail::take(c, s, q, v, detail::not_given{}, tau).call([&]() -> const auto& {
    const auto contacts = detail::contacts_of(c);
    auto& m = detail::contacts_in_lanes_of(c, s);
    auto& kept = s.work.kept;  // tau may be a result in the state
    for (int i = 0; i < s.dofs(); ++i)
      kept[static_cast<std::size_t>(i)] = static_cast<S>(tau[static_cast<std::size_t>(i)]);
    m.accelerate(contacts, s, tree::given_forces<S>(kept.data()));
    detail::check_result(s, detail::diagnose_state{"an acceleration", s});
    detail::write_numbers<detail::vector_of::a>(s, s.work.forces, "a");
    m.result.a = s.work.forces;
    for (std::size_t i = 0; i < m.result.contacts.size(); ++i)
      s.template get<kind::contact>(static_cast<int>(i)) = m.result.contacts[i];
    return m.result;
  });
}

}  // namespace kte
