#pragma once

#include <kte/dynamics/closed_loops/constrained_dynamics.hpp>
#include <kte/dynamics/looped/static_chains.hpp>

namespace kte::detail {

/// The closures of a static chain among its elements, as in dynamics/closed_loops/runtime_closures.hpp. `Is`: the
/// elements that count.
template <class Chain, class Given, template <class> class Is = closes_loop>
struct static_closures : static_elements<Chain, Given> {
  using wiring = typename Chain::wiring;

  const static_elements<Chain, Given>& elements() const { return *this; }
  template <class F>
  void each_closure(const F& f) const {
    each([&]<std::size_t I>(const auto&) { f(static_cast<int>(I)); });
  }
  closure_rows rows(int e) const {
    closure_rows r;
    at(e, [&r]<class Core>(const Core&) { r = Core::rows; });
    return r;
  }
  void close_frames(int e, const closing_motion<double>& m, closing what, double* rows) const {
    at(e, [&]<class Core>(const Core& core) {
      if constexpr (is_frame(Core::ports[0].what)) close_frames_by(core, m, what, rows);
    });
  }
  std::array<double, 2> close_coordinates(int e, const double* q, const double* v, double* gradient) const {
    std::array<double, 2> r{};
    at(e, [&]<class Core>(const Core& core) {
      if constexpr (!is_frame(Core::ports[0].what)) r = close_coordinates_by(core, q, v, gradient);
    });
    return r;
  }
  bool is_upright(int e, const closing_motion<double>& m) const {
    bool r = true;
    at(e, [&](const auto& core) { r = is_upright_by(core, m); });
    return r;
  }
  static int element_count() { return static_cast<int>(Chain::size); }
  static bool is_transmission(int e) {
    static constexpr auto is = []<std::size_t... I>(std::index_sequence<I...>) {
      return std::array<bool, Chain::size>{detail::is_transmission<core_of<Chain, I>>...};
    }
    (std::make_index_sequence<Chain::size>{});
    return is[static_cast<std::size_t>(e)];
  }
  static bool is_time(kind what, int slot) {
    for (int i = 0; i < wiring::table.signals; ++i)
      if (const auto& x = wiring::table.signal[static_cast<std::size_t>(i)]; x.what == what && x.slot == slot)
        return x.u < 0;
    return false;
  }
  static std::string describe(int e) {
    static constexpr auto types = []<std::size_t... I>(std::index_sequence<I...>) {
      return std::array<std::string_view, Chain::size>{std::string_view(core_of<Chain, I>::type)...};
    }
    (std::make_index_sequence<Chain::size>{});
    const auto ports_of = [](int i) { return static_elements<Chain, Given>::ports(i); };
    std::size_t first = 0;
    for (int i = 0; i < e; ++i) first += ports_of(i).size();
    const std::span<const std::string_view> names(names_of<kind::loop, Chain>::at_ports);
    return describe_element(types[static_cast<std::size_t>(e)], ports_of(e), names.subspan(first, ports_of(e).size()));
  }
  static std::string loop_name(int loop) { return name<kind::loop>(loop); }

 protected:
  template <kind K, class C>
  struct names_of;
  template <kind K, class Gravity, class... E>
  struct names_of<K, static_chain<Gravity, E...>> {
    static constexpr auto at_ports = names_at_ports<wiring, E...>();
    static constexpr auto table = [] {
      std::array<std::string_view, std::size_t{wiring::count(K)} + 1> names{};
      for (std::size_t p = 0; p < std::size_t{wiring::ports}; ++p)
        if (wiring::table.what[p] == K) names[static_cast<std::size_t>(wiring::table.slot[p])] = at_ports[p];
      return names;
    }();
  };
  template <kind K>
  static std::string name(int slot) {
    return std::string(names_of<K, Chain>::table[static_cast<std::size_t>(slot)]);
  }
  /// Calls f<number>(core of a closure).
  template <class F>
  void each(const F& f) const {
    const auto one = [&]<std::size_t I>() {
      if constexpr (Is<core_of<Chain, I>>::value) f.template operator()<I>(this->chain.template core<I>());
      return 0;
    };
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      const int done[]{one.template operator()<I>()...};
      (void)done;
    }
    (std::make_index_sequence<Chain::size>{});
  }
  template <class F>
  void at(int e, const F& f) const {
    each([&]<std::size_t I>(const auto& core) {
      if (e == static_cast<int>(I)) f(core);
    });
  }
};

/// The state of a static chain with closures, and the memory for its loops.
template <class Chain>
struct static_loop_state : static_state<double, Chain> {
  explicit static_loop_state(const Chain& c)
      : static_state<double, Chain>(c), loops(static_closures<Chain, nothing>{{c, nothing_given}}, *this) {}
  loop_workspace loops;

 private:
  static constexpr nothing nothing_given{};
};

}  // namespace kte::detail
