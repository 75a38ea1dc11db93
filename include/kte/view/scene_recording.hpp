#pragma once

#include <kte/dynamics/state_vectors.hpp>
#include <kte/view/recorded_scene.hpp>

#include <memory>

namespace kte {

/// Records a mechanism for pictures (`write_page`): poses of frames, coordinates, and quantities to plot:
///
///   kte::scene_recording rec(pendulum, {.columns = {"tip/velocity"}});
///   solver.integrate(10.0, kte::every(0.01), [&](double t, const auto& x) { rec.row(t, model.state_at(t, x)); });
///   kte::write_page("swing.html", rec);
///
/// For static chains, runtime chains, manipulators and robots.
template <drawable Chain>
class scene_recording : public recorded_scene {
 public:
  /// Throws `unknown_name` for a column that the chain does not have.
  explicit scene_recording(const Chain& chain, const recording_options& options = {})
      : recorded_scene(detail::parts_with_limits(chain), options), layout_(layout_of(detail::chain_in(chain))) {}

  /// Records the frames of the last `doMotion` of the state at time t, s. Throws `bad_argument` for a state of another
  /// chain, and for a time before that of the last row.
  template <class T, class State>
  void row(const T& t, const State& s) {
    numbers_of(s);
    add(static_cast<double>(t));
  }

  /// Records all rows of a table with the column t and those of the coordinates, by their names in `kte::recorder`,
  /// also inputs and internal states, if any. Other columns become plots. `s` is a state to work in. Throws
  /// `unknown_name` for coordinates without columns.
  template <class State>
  void rows(const Chain& chain, State& s, const table& numbers) {
    const auto plan = replay(detail::parts_of(chain), numbers);
    for (std::size_t i = 0; i < numbers.rows(); ++i) {
      const double t = (*plan.time)[i];
      for (const auto& x : plan.sources) detail::with_kind(x.what, [&]<kind K>() { put_thing<K>(x, i, t, s); });
      detail::chain_in(chain).doMotion(s);
      row(t, s);
    }
  }

 protected:
  /// The numbers of the state, in the order of `scene_row`.
  template <class State>
  const scene_row& numbers_of(const State& s) {
    check(s);
    auto& numbers = blank();
    double* out = numbers.poses.data();
    const auto put = [&out](const auto& x) { *out++ = static_cast<double>(x); };
    for (const auto& f : tracked()) detail::with_frame(s, f.what, f.slot, [&put](const auto& x) { put_pose(x, put); });
    out = numbers.q.data();
    for (const auto& f : freedoms())
      detail::with_coordinate(s, f.what, f.slot, [&put](const auto& c) { detail::visit_q(c, put); });
    out = numbers.v.data();
    for (const auto& f : freedoms())
      detail::with_coordinate(s, f.what, f.slot, [&put](const auto& c) { detail::visit_v(c, put); });
    out = numbers.signals.data();
    for (const auto& x : signals()) detail::with_kind(x.what, [&]<kind K>() { put_signal<K>(x.slot, s, put); });
    detail::read_recorded(cells(), s, numbers.cells.data());
    return numbers;
  }

 private:
  template <class C>
  static std::shared_ptr<const char> layout_of(const C& c) {
    if constexpr (requires { c.wiring().layout; }) {
      return c.wiring().layout;
    } else {
      return nullptr;
    }
  }
  template <class State>
  void check(const State& s) const {
    if constexpr (requires { typename Chain::wiring; }) {
      static_assert(std::is_same_v<typename State::wiring, typename Chain::wiring>,
                    "kte: this state was made for another chain");
    } else if (s.made_for()->layout != layout_) {
      detail::raise<bad_argument>("kte: this state was made for another chain than the recording");
    }
  }
  template <class S, class Put>
  static void put_pose(const frame_3D<S>& x, const Put& put) {
    detail::visit_vector(x.position, put);
    for (const auto* row : {&x.rotation.x, &x.rotation.y, &x.rotation.z}) detail::visit_vector(*row, put);
  }
  template <class S, class Put>
  static void put_pose(const frame_2D<S>& x, const Put& put) {
    const auto &c = x.rotation.cos, &s = x.rotation.sin;
    put(x.position.x), put(x.position.y), put(0);
    put(c), put(-s), put(0), put(s), put(c), put(0), put(0), put(0), put(1);
  }
  /// Whether a static chain has nothing of a kind.
  template <kind K, class State>
  static constexpr bool has_none = [] {
    if constexpr (requires { typename State::wiring; })
      return State::wiring::count(K) == 0;
    else
      return false;
  }();
  template <kind K, class State, class Put>
  static void put_signal(int slot, const State& s, const Put& put) {
    if constexpr (has_none<K, State>)
      return;
    else if constexpr (K == kind::input)
      put(s.template get<K>(slot));
    else if constexpr (K == kind::internal)
      put(s.template get<K>(slot).z);
    else if constexpr (K == kind::vector)
      detail::visit_vector(s.template get<K>(slot), put);
  }
  template <kind K, class State>
  static void put_thing(const detail::thing_source& from, std::size_t row, double t, State& s) {
    if constexpr (!is_frame(K) && K != kind::loop && K != kind::contact) {
      std::size_t column = 0;
      const auto take = [&](auto& x) {
        x = static_cast<std::remove_reference_t<decltype(x)>>(from.columns.empty() ? t
                                                                                   : (*from.columns[column++])[row]);
      };
      auto& thing = s.template get<K>(from.slot);
      if constexpr (K == kind::input)
        take(thing);
      else if constexpr (K == kind::internal)
        take(thing.z);
      else if constexpr (K == kind::vector)
        detail::visit_vector(thing, take);
      else if (from.rates)
        detail::visit_v(thing, take);
      else
        detail::visit_q(thing, take);
    }
  }

  std::shared_ptr<const char> layout_;
};

}  // namespace kte
