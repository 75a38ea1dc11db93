#pragma once

#include <kte/chain/working_element.hpp>

namespace kte::detail {

/// One element in the articulated-body algorithm on a runtime chain.
template <class Core>
struct working_articulated : working_element<Core> {
  using element = working_element<Core>;
  using element::base, element::core, element::end, element::joint, element::place, element::state;
  template <std::size_t P>
  static constexpr port at = Core::ports[P];

  /// Motion by rates, and the loads and masses of what moves nothing.
  void move_by_rates() const {
    element::move_by_rates();
    if constexpr (!element::stiff) {
      if constexpr (at<0>.what == kind::gen && has_mass<Core, double>) {
        state.work
            .own_mass[static_cast<std::size_t>(state.work.row_of_gen[static_cast<std::size_t>(this->index[0])])] +=
            as<double>(core.template mass<double>());
      }
      if constexpr (!element::writes_coordinate) this->template push<true>();
    } else {
      burden_of<end>() = {};
    }
  }
  /// What the end carries, to the base.
  void articulate() const {
    if constexpr (has_mass<Core, double> && is_frame(at<0>.what)) {
      auto& i = burden_of<0>().inertia;
      i = dense_inertia(i + to_articulated(core.template mass<double>()));
    } else if constexpr (element::stiff) {
      const auto& at_end = burden_of<end>();
      const burden carried{at_end.inertia, at_end.load + this->template frame<end>().load};
      if constexpr (joint) {
        if (place.free) return give_way(carried);
      }
      add(carried_stiffly(this->pose(), this->template frame<end>(), carried));
    }
  }
  void accelerate() const {
    if constexpr (element::stiff) {
      auto& to = acceleration_of<end>();
      const auto before = carried_acceleration(this->pose(), this->template frame<end>(), acceleration_of<base>());
      if constexpr (joint) {
        if (place.free) return respond(before, to);
      }
      set(to, before);
    }
  }

 private:
  template <std::size_t P>
  auto& burden_of() const {
    return state.work.burdens.template get<at<P>.what>(this->index[P]);
  }
  template <std::size_t P>
  auto& acceleration_of() const {
    return state.work.accelerations.template get<at<P>.what>(this->index[P]);
  }
  template <class A>
  static void set(acceleration<vec3<>, vec3<>>& to, const A& a) {
    to = {as<double>(a.linear), as<double>(a.angular)};
  }
  template <class I>
  static workspace::articulated_3D dense_inertia(const I& i) {
    return {as<double>(i.linear), as<double>(i.coupling), as<double>(i.angular)};
  }
  template <class B>
  void add(const B& b) const {
    auto& to = burden_of<base>();
    to = {dense_inertia(to.inertia + b.inertia), dense(to.load + b.load)};
  }

  static constexpr int axes = joint ? joint_dofs<Core> : 0;
  std::size_t row() const { return static_cast<std::size_t>(place.row); }
  /// f(m) with the further mass on its coordinate, which is mostly none.
  template <class F>
  auto with_mass(const F& f) const {
    if constexpr (at<0>.what == kind::gen) {
      const double m = state.work.own_mass[row()];
      if (m != 0) return f(m);
    }
    return f(zero);
  }
  template <class B>
  void give_way(const B& carried) const {
    auto& w = state.work;
    joint_response<double, axes> r;
    const auto force = [this]<int N>() { return state.work.forces[place.row + N]; };
    with_mass([&](const auto& m) {
      add(carried_by_joint<double>(core, this->coordinate(), this->template frame<end>(), carried, force, m, r,
                                   w.good));
    });
    for (std::size_t k = 0; k < std::size_t{axes}; ++k) w.gains[row() + k] = r.gain[k], w.rates[row() + k] = r.rate[k];
  }
  template <class A, class To>
  void respond(const A& before, To& to) const {
    auto& w = state.work;
    joint_response<double, axes> r;
    for (std::size_t k = 0; k < std::size_t{axes}; ++k) r.gain[k] = w.gains[row() + k], r.rate[k] = w.rates[row() + k];
    const auto put = [this](int k, double x) { state.work.forces[place.row + k] = x; };
    with_mass([&](const auto& m) { set(to, accelerated(core, this->coordinate(), r, m, before, put)); });
  }
};

}  // namespace kte::detail
