#pragma once

#include <kte/chain/memory.hpp>
#include <kte/chain/passes.hpp>

/// One element in the algorithms that are loops over elements: its kernels on the working memory of a state, where
/// frames have no positions and velocities. State: `runtime_state`, or `stored_state` of a large static chain.
///   state.get<K>(i)   thing i of kind K
///   state.work        its working memory (chain/memory.hpp)
///   state.plan        the order of work (chain/plan.hpp)
namespace kte::detail {

template <class S, class F, class T>
dense_wrench<S> dense(const wrench<F, T>& w) {
  return {as<S>(w.force), as<S>(w.torque)};
}

/// What it is connected to, its motion and its forces.
template <class Core, class State>
struct working_element {
  using S = typename State::scalar;
  const Core& core;
  State& state;
  const int* index;  ///< of what each port is connected to
  const detail::place& place;

  static constexpr std::size_t ports = port_count<Core>;
  template <std::size_t P>
  static constexpr port at = Core::ports[P];
  static constexpr bool stiff = is_transmission<Core>;
  static constexpr std::size_t base = stiff ? ports - 2 : 0, end = ports - 1;
  static constexpr bool joint = stiff && base == 1;
  static constexpr bool writes_coordinate = at<end>.what == kind::gen && at<end>.how == access::out;
  using inputs = std::make_index_sequence<input_count<Core>>;

  template <std::size_t P>
  auto& thing() const {
    return state.template get<at<P>.what>(index[P]);
  }
  template <std::size_t P>
  auto& frame() const {
    return state.work.frames.template get<at<P>.what>(index[P]);
  }
  auto coordinate() const {
    if constexpr (at<0>.what == kind::gen) {
      return thing<0>();
    } else {
      return spatial(thing<0>());
    }
  }
  /// A joint or link where it is.
  auto pose() const {
    if constexpr (joint) {
      return core.relative(position_only(coordinate()));
    } else {
      return core.relative();
    }
  }

  /// Whether it is a joint that moves under forces; otherwise its acceleration is given.
  bool yields() const { return place.free && !state.work.prescribed[static_cast<std::size_t>(place.row)]; }

  // ---- motion
  void follow() const {
    if constexpr (writes_coordinate) {
      stored().move(inputs{});
      update_angle(thing<end>());
    }
  }
  void move_fully() const {
    if constexpr (writes_coordinate) {
      follow();
    } else {
      stored().move(inputs{});
    }
  }
  void push_fully() const {
    if constexpr (reads_positions<Core>) stored().force(inputs{});
  }
  void move() const {
    if constexpr (joint) {
      set_motion(compose(seen<base, false>(), core.relative(coordinate())));
    } else if constexpr (stiff) {
      set_motion(compose(seen<base, false>(), core.relative()));
    } else {
      follow();
    }
  }
  /// Leaves in the end's acceleration what the rates alone make; of a coordinate that is given, also its acceleration.
  void move_by_rates() const {
    if constexpr (joint) {
      if (yields())
        set_motion(compose(seen<base, true>(), core.relative(unaccelerated(coordinate()))));
      else
        set_motion(compose(seen<base, true>(), core.relative(coordinate())));
    } else if constexpr (stiff) {
      set_motion(compose(seen<base, true>(), core.relative()));
    } else {
      follow();
    }
  }

  // ---- forces; with RatesOnly without those of accelerations
  template <bool RatesOnly>
  void push() const {
    if constexpr (!reads_positions<Core>) push<RatesOnly>(inputs{});
  }
  /// Of an element that writes nothing: what it puts on things.
  template <std::size_t... P>
  auto loads(std::index_sequence<P...>) const {
    return core.doForce(seen<P, false>()...);
  }

 private:
  auto stored() const { return stored_element<Core, State, by_index>{core, state, {index}}; }
  template <bool RatesOnly, class C>
  static decltype(auto) coordinate_seen(const C& c) {
    if constexpr (requires { c.q; }) {
      if constexpr (RatesOnly) {
        return unaccelerated(c);
      } else {
        return (c);
      }
    } else {
      if constexpr (RatesOnly) {
        return unaccelerated(spatial(c));
      } else {
        return spatial(c);
      }
    }
  }
  /// As kernels see it.
  template <std::size_t P, bool RatesOnly>
  decltype(auto) seen() const {
    if constexpr (is_signal(at<P>.what)) {
      return number_of_signal<at<P>.what>(thing<P>());
    } else if constexpr (!is_frame(at<P>.what)) {
      return coordinate_seen<RatesOnly>(thing<P>());
    } else if constexpr (RatesOnly) {
      return motion{skip{}, skip{}, skip{}, frame<P>().ang_velocity, zero3{}, zero3{}};
    } else {
      const auto& x = frame<P>();
      return motion{skip{}, skip{}, skip{}, x.ang_velocity, x.acceleration, x.ang_acceleration};
    }
  }
  template <class M>
  void set_motion(const M& m) const {
    frame<end>() = {as<S>(m.ang_velocity), as<S>(m.acceleration), as<S>(m.ang_acceleration), {}};
  }
  template <bool RatesOnly, std::size_t... P>
  void push(std::index_sequence<P...>) const {
    if constexpr (writes_coordinate) {
      spread<P...>(core.doForce(seen<P, RatesOnly>()..., thing<end>().f));
    } else if constexpr (stiff) {
      spread<P...>(core.doForce(seen<P, RatesOnly>()..., frame<end>().load));
    } else {
      spread<P...>(core.doForce(seen<P, RatesOnly>()...));
    }
  }
  template <std::size_t... P, class Loads>
  void spread(const Loads& l) const {
    static_assert(sizeof(check_need<Core, !has_skip<Loads>>) > 0);
    if constexpr (!has_skip<Loads>) {
      std::size_t done[]{(add<P>(l), std::size_t{0})..., 0};
      (void)done;
    }
  }
  template <std::size_t P, class Loads>
  void add(const Loads& l) const {
    constexpr std::size_t i = load_index<Core, P>;
    if constexpr (at<P>.what == kind::gen) {
      thing<P>().f = thing<P>().f + boost::hana::at_c<i>(l);
    } else if constexpr (is_frame(at<P>.what)) {
      frame<P>().load = dense<S>(frame<P>().load + boost::hana::at_c<i>(l));
    } else if constexpr (!is_signal(at<P>.what)) {
      add_load(thing<P>(), boost::hana::at_c<i>(l));
    }
  }
};

}  // namespace kte::detail
