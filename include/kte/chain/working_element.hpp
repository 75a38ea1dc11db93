#pragma once

#include <kte/chain/passes.hpp>
#include <kte/chain/runtime_state.hpp>

/// One element in the algorithms on runtime chains: its kernels on the working memory of a state, where frames have no
/// positions and velocities.
namespace kte::detail {

template <class F, class T>
wrench_3D dense(const wrench<F, T>& w) {
  return {as<double>(w.force), as<double>(w.torque)};
}

/// What it is connected to, its motion and its forces.
template <class Core>
struct working_element {
  const Core& core;
  runtime_state& state;
  const int* index;  ///< of what each port is connected to
  const workspace::place& place;

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
    return state.get<at<P>.what>(index[P]);
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

  // ---- motion
  void follow() const {
    if constexpr (writes_coordinate) {
      stored_element<Core, runtime_state, where>{core, state, {index}}.motion(inputs{});
      update_angle(thing<end>());
    }
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
      if (place.free)
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

 private:
  struct where {
    const int* index;
    template <std::size_t P>
    int at() const {
      return index[P];
    }
  };
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
    if constexpr (at<P>.what == kind::input) {
      return std::as_const(thing<P>());
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
    frame<end>() = {as<double>(m.ang_velocity), as<double>(m.acceleration), as<double>(m.ang_acceleration), {}};
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
    std::size_t done[]{(add<P>(l), std::size_t{0})..., 0};
    (void)done;
  }
  template <std::size_t P, class Loads>
  void add(const Loads& l) const {
    constexpr std::size_t i = load_index<Core, P>;
    if constexpr (at<P>.what == kind::gen) {
      thing<P>().f = thing<P>().f + boost::hana::at_c<i>(l);
    } else if constexpr (is_frame(at<P>.what)) {
      frame<P>().load = dense(frame<P>().load + boost::hana::at_c<i>(l));
    } else if constexpr (at<P>.what != kind::input) {
      add_load(thing<P>(), boost::hana::at_c<i>(l));
    }
  }
};

}  // namespace kte::detail
