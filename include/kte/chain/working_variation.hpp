#pragma once

#include <kte/chain/working_element.hpp>
#include <kte/kernels/coordinate_variation.hpp>

namespace kte::detail {

/// One element in the derivatives of inverse dynamics (kernels/variation.hpp), after its motion and forces are known.
template <class Core, class State>
struct working_variation : working_element<Core, State> {
  using element = working_element<Core, State>;
  using element::base, element::core, element::end, element::joint, element::place, element::state;
  using typename element::S;
  template <std::size_t P>
  static constexpr port at = Core::ports[P];

  /// Adds what the end carries to what the base carries, and takes the columns of the joints beyond one element further
  /// in; a joint adds its own columns, and its own rows and columns to the matrices.
  void vary() const {
    if constexpr (has_mass<Core, S> && is_frame(at<0>.what)) {
      const auto i = core.template mass<S>();
      add(body<0>(), turning_body{i, gyration_of(i, this->template frame<0>().ang_velocity)});
    } else if constexpr (element::stiff) {
      const auto x = relative();
      const auto& c = body<end>();
      if constexpr (joint) {
        if (place.free) own_axes(x, std::make_integer_sequence<int, joint_dofs<Core>>{});
      }
      const auto& w = this->template frame<base>().ang_velocity;
      add(body<base>(),
          turning_body{transported(x.rotation, x.position, c.inertia), gyration_through(x, w, c.inertia, c.gyration)});
      for (std::size_t k = place.first; k < place.last; ++k) {
        auto& a = state.work.axes[k];
        a.by_q = dense<S>(transmit(x, a.by_q)), a.by_v = dense<S>(transmit(x, a.by_v));
        set(a.row, sensitivity_through(x, w, a.row));
      }
    }
  }
  /// Elements on coordinates: subtracts the derivatives of their forces, for tau is what they do not give.
  void vary_coordinates() const {
    if constexpr (is_on_coordinates<Core> && !element::writes_coordinate) by_ports(typename element::inputs{});
  }

 private:
  template <std::size_t P>
  auto& body() const {
    return state.work.bodies.template get<at<P>.what>(this->index[P]);
  }
  template <class B>
  static void add(dense_body<S>& to, const B& b) {
    const auto i = to.inertia + b.inertia;
    const auto g = to.gyration + b.gyration;
    to = {{as<S>(i.mass), as<S>(i.moment), as<S>(i.inertia)}, {as<S>(g.force), as<S>(g.torque)}};
  }
  template <class To, class Z>
  static void set(To& to, const Z& z) {
    to = {dense<S>(z.to_acceleration), as<S>(z.to_rate)};
  }
  auto relative() const {
    if constexpr (joint) {
      return core.relative(this->coordinate());
    } else {
      return core.relative();
    }
  }
  template <class M, class T>
  static void put(M& m, int i, int j, const T& x) {
    m(i, j) = as<S>(x);
  }
  template <int... N>
  auto all_axes(std::integer_sequence<int, N...>) const {
    return make_loads(axis_of<N>(core, this->coordinate())...);
  }

  template <class X, int... N>
  void own_axes(const X& x, std::integer_sequence<int, N...> all) const {
    const auto axes = all_axes(all);
    const int done[]{(own_axis<N>(x, axes, all), 0)...};
    (void)done;
  }
  /// Column N, and the entries of axis N with the axes of the joint and with all columns beyond it.
  template <int N, class X, class Axes, int... K>
  void own_axis(const X& x, const Axes& axes, std::integer_sequence<int, K...>) const {
    auto& [tau, by_q, by_v, by_a] = *state.work.derivatives;
    const auto& s = boost::hana::at_c<std::size_t{N}>(axes);
    const auto& c = body<end>();
    const auto& at_base = this->template frame<base>();
    const auto displaced = by_displacement(x, s, at_base);
    const auto faster = by_rate(x, s, at_base);
    const auto q = varied_wrench(c.inertia, c.gyration, displaced);
    const auto v = varied_wrench(c.inertia, c.gyration, faster);
    const auto z = sensitivity_along(c.inertia, c.gyration, s);
    const int i = place.row + N;
    const int done[]{(put(by_q, place.row + K, i, power(boost::hana::at_c<std::size_t{K}>(axes), q)),
                      put(by_v, place.row + K, i, power(boost::hana::at_c<std::size_t{K}>(axes), v)),
                      put(by_a, place.row + K, i, power(boost::hana::at_c<std::size_t{K}>(axes), z.to_acceleration)),
                      0)...};
    (void)done;
    auto& own = state.work.axes[place.first + std::size_t{N}];
    own.by_q = dense<S>(q - by_displacement(s, this->template frame<end>().load)), own.by_v = dense<S>(v);
    set(own.row, z);
    state.work.row_of_axis[place.first + std::size_t{N}] = i;

    for (std::size_t k = place.first + sizeof...(K); k < place.last; ++k) {
      const auto& beyond = state.work.axes[k];
      const int j = state.work.row_of_axis[k];
      if (j < 0) continue;  // of a coordinate that is given
      put(by_q, i, j, power(s, beyond.by_q)), put(by_q, j, i, change(beyond.row, displaced));
      put(by_v, i, j, power(s, beyond.by_v)), put(by_v, j, i, change(beyond.row, faster));
      const auto m = power(s, beyond.row.to_acceleration);
      put(by_a, i, j, m), put(by_a, j, i, m);
    }
  }

  // ---- elements on coordinates
  template <std::size_t P>
  int row() const {
    if constexpr (at<P>.what == kind::gen) {
      const int row = state.plan.row_of_gen[static_cast<std::size_t>(this->index[P])];
      return row < state.dofs() ? row : -1;
    } else {
      return -1;
    }
  }
  template <std::size_t... P>
  void by_ports([[maybe_unused]] std::index_sequence<P...> all) const {
    const int done[]{(row<P>() < 0 || is_again<P>() ? 0 : (by_port<P>(all), 0))..., 0};
    (void)done;
  }
  /// Whether port P leads to the coordinate of a port before it: `seen` then varies both at once.
  template <std::size_t P>
  bool is_again() const {
    for (std::size_t before = 0; before < P; ++before)
      if (Core::ports[before].what == kind::gen && this->index[before] == this->index[P]) return true;
    return false;
  }
  /// By the coordinate at port L.
  template <std::size_t L, std::size_t... P>
  void by_port(std::index_sequence<P...>) const {
    if constexpr (at<L>.what == kind::gen) {
      const auto loads = core.doForce(seen<P, L>()...);
      const int done[]{(row<P>() < 0 ? 0 : (subtract<P, L>(loads), 0))...};
      (void)done;
    }
  }
  template <std::size_t P, std::size_t L>
  auto seen() const {
    if constexpr (at<P>.what == kind::gen) {
      return varied_coordinate<S>(this->template thing<P>(), this->index[P] == this->index[L]);
    } else {
      return number_of_signal<at<P>.what>(this->template thing<P>());
    }
  }
  template <std::size_t P, std::size_t L, class Loads>
  void subtract(const Loads& loads) const {
    if constexpr (at<P>.what == kind::gen) {
      auto& [tau, by_q, by_v, by_a] = *state.work.derivatives;
      subtract_variation<S>(boost::hana::at_c<load_index<Core, P>>(loads), by_q, by_v, by_a, row<P>(), row<L>());
    }
  }
};

}  // namespace kte::detail
