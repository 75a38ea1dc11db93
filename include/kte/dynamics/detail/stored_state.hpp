#pragma once

#include <kte/chain/memory.hpp>
#include <kte/dynamics/detail/given.hpp>
#include <kte/dynamics/detail/static_plan.hpp>

/// The state of a static chain for the algorithms that are loops over elements.
namespace kte::detail {

template <class Chain>
struct sizes_of {
  using wiring = typename Chain::wiring;
  static constexpr std::size_t in_plane = static_cast<std::size_t>(wiring::count(kind::frame_2D));
  static constexpr std::size_t in_space = static_cast<std::size_t>(wiring::count(kind::frame_3D));
  static constexpr std::size_t dofs = static_cast<std::size_t>(wiring::dofs);
  static constexpr std::size_t coordinates = static_cast<std::size_t>(static_plan<Chain>.coordinates);
  static constexpr std::size_t columns = static_plan<Chain>.columns;
};

/// Coordinates and signals, frames only if positions are wanted, and working memory.
template <class S, class Chain, template <class, class> class... Memory>
class stored_state {
  using wiring = typename Chain::wiring;

 public:
  using scalar = S;
  struct memory : Memory<S, sizes_of<Chain>>... {};
  static constexpr auto& plan = static_plan<Chain>;
  memory work;

  /// All that comes from outside (dynamics/detail/given.hpp).
  template <class Given>
  explicit stored_state(const Given& g) {
    take_coordinates(g, std::make_index_sequence<wiring::freedoms>{});
    take_fixed(g, std::make_integer_sequence<int, wiring::count(kind::gen)>{});
    take_inputs(g, std::make_integer_sequence<int, wiring::count(kind::input)>{});
    take_internals(g, std::make_integer_sequence<int, wiring::count(kind::internal)>{});
    if constexpr (requires { work.frames; })
      for_each_base<wiring>([&]<kind K, int Slot>() { take_base<K, Slot>(g.template base<K, Slot>()); });
    if constexpr (requires { work.prescribed; }) work.prescribed.fill(0);
  }

  template <kind K>
  auto& get(int i) {
    return of_kind<K>(things_)[static_cast<std::size_t>(i)];
  }
  template <kind K>
  const auto& get(int i) const {
    return of_kind<K>(things_)[static_cast<std::size_t>(i)];
  }
  static constexpr int dofs() { return wiring::dofs; }
  static std::span<const freedom> freedoms() { return {wiring::table.free.data(), wiring::freedoms}; }

 private:
  /// Numbers that nobody asked for stay zero.
  template <class To, class From>
  static void take(To& to, const From& from) {
    if constexpr (std::is_same_v<To, S>) {
      if constexpr (!std::is_same_v<From, skip>) to = as<S>(from);
    } else {
      take(to.x, from.x), take(to.y, from.y);
      if constexpr (requires { to.z; }) take(to.z, from.z);
    }
  }
  template <class C>
  static void take_coordinate(gen_coord<S>& to, const C& c) {
    take(to.q, c.q), take(to.q_dot, c.q_dot), take(to.q_ddot, c.q_ddot), take(to.cos, c.cos), take(to.sin, c.sin);
  }
  template <class M>
  static void take_coordinate(pose_coord_2D<S>& to, const M& m) {
    take(to.position, m.position), take(to.cos, m.rotation.cos), take(to.sin, m.rotation.sin);
    take(to.velocity, m.velocity), take(to.ang_velocity, m.ang_velocity.z);
    take(to.acceleration, m.acceleration), take(to.ang_acceleration, m.ang_acceleration.z);
  }
  template <class To, class M>
  static void take_coordinate(To& to, const M& m) {
    to.matrix = m.rotation;
    if constexpr (requires { to.position; })
      take(to.position, m.position), take(to.velocity, m.velocity), take(to.acceleration, m.acceleration);
    take(to.ang_velocity, m.ang_velocity), take(to.ang_acceleration, m.ang_acceleration);
  }
  template <class Given, std::size_t... F>
  void take_coordinates(const Given& g, std::index_sequence<F...>) {
    const int done[]{
        (take_coordinate(get<wiring::template free<F>.what>(wiring::template free<F>.slot),
                         g.template coordinate<wiring::template free<F>.what, wiring::template free<F>.slot>()),
         0)...,
        0};
    (void)done;
  }
  template <class Given, int... I>
  void take_fixed(const Given& g, std::integer_sequence<int, I...>) {
    [[maybe_unused]] const auto one = [&]<int Slot>() {
      if constexpr (wiring::writer(kind::gen, Slot) < 0 && !wiring::template is_free<kind::gen, Slot>)
        take_coordinate(get<kind::gen>(Slot), g.template fixed<Slot>());
      return 0;
    };
    const int done[]{one.template operator()<I>()..., 0};
    (void)done;
  }
  template <class Given, int... I>
  void take_inputs(const Given& g, std::integer_sequence<int, I...>) {
    const int done[]{(get<kind::input>(I) = as<S>(g.template input<I>()), 0)..., 0};
    (void)done;
  }
  template <class Given, int... I>
  void take_internals(const Given& g, std::integer_sequence<int, I...>) {
    const int done[]{(get<kind::internal>(I).z = as<S>(g.template internal<I>()), 0)..., 0};
    (void)done;
  }
  template <kind K, int Slot, class M>
  void take_base(const M& m) {
    auto& x = work.frames.template get<K>(Slot);
    take(x.ang_velocity, m.ang_velocity), take(x.acceleration, m.acceleration);
    take(x.ang_acceleration, m.ang_acceleration);
    if constexpr (Chain::reads_positions)
      set_motion(get<K>(Slot),
                 motion{m.position, m.rotation, m.velocity, m.ang_velocity, m.acceleration, m.ang_acceleration});
  }

  template <class Kinds>
  struct lists;
  template <std::size_t... K>
  struct lists<std::index_sequence<K...>> {
    static constexpr std::size_t count(kind k) {
      return is_frame(k) && !Chain::reads_positions ? 0 : static_cast<std::size_t>(wiring::count(k));
    }
    using type = std::tuple<std::array<thing_of<static_cast<kind>(K), S>, count(static_cast<kind>(K))>...>;
  };
  typename lists<std::make_index_sequence<kinds>>::type things_{};
};

}  // namespace kte::detail
