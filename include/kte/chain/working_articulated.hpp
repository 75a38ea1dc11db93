#pragma once

#include <kte/chain/thing.hpp>
#include <kte/chain/working_element.hpp>

namespace kte::detail {

/// One element in the articulated-body algorithm.
template <class Core, class State>
struct working_articulated : working_element<Core, State> {
  using element = working_element<Core, State>;
  using element::base, element::core, element::end, element::joint, element::place, element::state;
  using typename element::S;
  template <std::size_t P>
  static constexpr port at = Core::ports[P];

  /// Motion by rates, and the loads and masses of what moves nothing.
  void move_by_rates() const {
    element::move_by_rates();
    if constexpr (!element::stiff) {
      add_own_mass();
      if constexpr (!element::writes_coordinate) this->template push<true>();
    } else {
      burden_of<end>() = {};
    }
  }
  /// What the end carries, to the base.
  void articulate() const {
    if constexpr (has_mass<Core, S> && is_frame(at<0>.what)) {
      auto& i = burden_of<0>().inertia;
      i = dense_inertia(i + to_articulated(core.template mass<S>()));
    } else if constexpr (element::stiff) {
      const auto& at_end = burden_of<end>();
      const burden carried{at_end.inertia, at_end.load + this->template frame<end>().load};
      if constexpr (joint) {
        if (this->yields()) return give_way(carried);
      }
      add(carried_stiffly(this->pose(), this->template frame<end>(), carried));
    }
  }
  void accelerate() const {
    if constexpr (element::stiff) {
      auto& to = acceleration_of<end>();
      const auto before = carried_acceleration(this->pose(), this->template frame<end>(), acceleration_of<base>());
      if constexpr (joint) {
        if (this->yields()) return respond(before, to);
        if (place.free) put_given();
      }
      set(to, before);
    }
  }

  // ---- the inverse of the mass matrix: the same on a chain at rest without loads
  void rest() const {
    if constexpr (element::stiff) {
      this->template frame<end>() = {};
      burden_of<end>() = {};
    } else {
      add_own_mass();
    }
  }
  /// What comes down from a unit force, from the end to the base.
  void load_down() const {
    auto& w = state.work;
    if constexpr (joint) {
      if (this->yields()) return answer();
    }
    if constexpr (element::stiff) w.load = dense<S>(transmit(this->pose(), w.load));
  }

 private:
  void add_own_mass() const {
    if constexpr (at<0>.what == kind::gen && has_mass<Core, S>) {
      auto& m =
          state.work
              .own_mass[static_cast<std::size_t>(state.plan.row_of_gen[static_cast<std::size_t>(this->index[0])])];
      m = as<S>(m + core.template mass<S>());
    }
  }
  void put_given() const {
    auto i = Eigen::Index{place.row};
    visit_a(this->template thing<0>(), [this, &i](const S& x) { state.work.forces[i++] = x; });
  }
  void answer() const {
    auto& w = state.work;
    joint_response<S, axes> r;
    std::array<S, std::size_t{axes}> force{};
    for (std::size_t k = 0; k < std::size_t{axes}; ++k) {
      r.gain[k] = w.gains[row() + k];
      for (std::size_t i = 0; i < std::size_t{axes}; ++i) r.inverse[k][i] = w.inverses[row() + k][i];
      force[k] = S(place.row + static_cast<int>(k) == w.unit ? 1 : 0);
    }
    with_mass(
        [&](const auto& m) { w.load = dense<S>(transmitted_by_joint(core, this->coordinate(), m, w.load, force, r)); });
    for (std::size_t k = 0; k < std::size_t{axes}; ++k) {
      const auto i = place.row + static_cast<int>(k);
      w.left[i] = force[k], w.rate[i] = r.rate[k];
    }
  }
  template <std::size_t P>
  auto& burden_of() const {
    return state.work.burdens.template get<at<P>.what>(this->index[P]);
  }
  template <std::size_t P>
  auto& acceleration_of() const {
    return state.work.accelerations.template get<at<P>.what>(this->index[P]);
  }
  template <class A>
  static void set(dense_acceleration<S>& to, const A& a) {
    to = {as<S>(a.linear), as<S>(a.angular)};
  }
  template <class I>
  static dense_articulated<S> dense_inertia(const I& i) {
    return {as<S>(i.linear), as<S>(i.coupling), as<S>(i.angular)};
  }
  template <class B>
  void add(const B& b) const {
    auto& to = burden_of<base>();
    to = {dense_inertia(to.inertia + b.inertia), dense<S>(to.load + b.load)};
  }

  static constexpr int axes = joint ? joint_dofs<Core> : 0;
  std::size_t row() const { return static_cast<std::size_t>(place.row); }
  /// f(m) with the further mass on its coordinate, which is mostly none.
  template <class F>
  auto with_mass(const F& f) const {
    if constexpr (at<0>.what == kind::gen) {
      const S m = state.work.own_mass[row()];
      if (!all(m == S(0))) return f(m);
    }
    return f(zero);
  }
  template <class B>
  void give_way(const B& carried) const {
    auto& w = state.work;
    joint_response<S, axes> r;
    const auto force = [this]<int N>() { return state.work.forces[place.row + N]; };
    with_mass([&](const auto& m) {
      add(carried_by_joint<S>(core, this->coordinate(), this->template frame<end>(), carried, force, m, r, w.good));
    });
    for (std::size_t k = 0; k < std::size_t{axes}; ++k) {
      w.gains[row() + k] = r.gain[k], w.rates[row() + k] = r.rate[k];
      for (std::size_t i = 0; i < std::size_t{axes}; ++i) w.inverses[row() + k][i] = r.inverse[k][i];
    }
  }
  joint_response<S, axes> response() const {
    auto& w = state.work;
    joint_response<S, axes> r;
    for (std::size_t k = 0; k < std::size_t{axes}; ++k) r.gain[k] = w.gains[row() + k], r.rate[k] = w.rates[row() + k];
    return r;
  }
  template <class A, class To>
  void respond(const A& before, To& to) const {
    const auto r = response();
    const auto put = [this](int k, const S& x) { state.work.forces[place.row + k] = x; };
    with_mass([&](const auto& m) { set(to, accelerated(core, this->coordinate(), r, m, before, put)); });
  }
};

}  // namespace kte::detail
