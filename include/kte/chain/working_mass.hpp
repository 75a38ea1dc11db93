#pragma once

#include <kte/chain/working_element.hpp>

namespace kte::detail {

/// One element in the composite-rigid-body algorithm.
template <class Core, class State>
struct working_mass : working_element<Core, State> {
  using element = working_element<Core, State>;
  using element::base, element::core, element::end, element::joint, element::place, element::state;
  using typename element::S;
  template <std::size_t P>
  static constexpr port at = Core::ports[P];

  /// Adds what the end carries to what the base carries, and takes the columns of the joints beyond one element further
  /// in; a joint adds its own columns, and its own rows to the matrix.
  void carry() const {
    if constexpr (has_mass<Core, S> && is_frame(at<0>.what)) {
      add(carried<0>(), core.template mass<S>());
    } else if constexpr (element::stiff) {
      const auto x = this->pose();
      if constexpr (joint) own_columns(std::make_integer_sequence<int, joint_dofs<Core>>{});
      add(carried<base>(), transported(x.rotation, x.position, carried<end>()));
      carry_columns(x);
    }
  }
  /// A mass on a coordinate; or a follower, whose row and column count for what it follows too: q_e' = ratio q_b'.
  void carry_coordinate() const {
    if constexpr (at<0>.what == kind::gen && (has_mass<Core, S> || element::writes_coordinate)) {
      auto& m = matrix();
      const int b = row<0>();
      if constexpr (has_mass<Core, S>) {
        m(b, b) += as<S>(core.template mass<S>());
      } else {
        const int e = row<end>();
        const S ratio = as<S>(core.doMotion(unit_rate<kind::gen, 0>(this->coordinate())).q_dot);
        m.row(b) += ratio * m.row(e);
        m.col(b) += ratio * m.col(e);
      }
    }
  }

 private:
  template <std::size_t P>
  auto& carried() const {
    return state.work.carried.template get<at<P>.what>(this->index[P]);
  }
  template <class C>
  static void add(dense_composite<S>& to, const C& c) {
    to = {as<S>(to.mass + c.mass), as<S>(to.moment + c.moment), as<S>(to.inertia + c.inertia)};
  }
  auto& matrix() const { return matrix_over_all(state.work); }
  template <std::size_t P>
  int row() const {
    return state.plan.row_of_gen[static_cast<std::size_t>(this->index[P])];
  }

  /// The columns, as arrays of their components.
  struct columns {
    S *fx, *fy, *fz, *tx, *ty, *tz;
    template <class Memory>
    explicit columns(Memory& w)
        : fx(w.column[0].data()),
          fy(w.column[1].data()),
          fz(w.column[2].data()),
          tx(w.column[3].data()),
          ty(w.column[4].data()),
          tz(w.column[5].data()) {}
    dense_wrench<S> get(std::size_t k) const { return {{fx[k], fy[k], fz[k]}, {tx[k], ty[k], tz[k]}}; }
    template <class W>
    void set(std::size_t k, const W& x) const {
      const auto w = dense<S>(x);
      fx[k] = w.force.x, fy[k] = w.force.y, fz[k] = w.force.z;
      tx[k] = w.torque.x, ty[k] = w.torque.y, tz[k] = w.torque.z;
    }
  };
  template <int... N>
  void own_columns(std::integer_sequence<int, N...>) const {
    const columns w(state.work);
    const auto c = this->coordinate();
    const auto& i = carried<end>();
    const int rows[]{(w.set(place.first + std::size_t{N}, accelerating_wrench(i, axis_of<N>(core, c))),
                      state.work.row_of_column[place.first + std::size_t{N}] = place.row + N)...};
    const int done[]{own_row<N>(w, c)...};
    (void)rows, (void)done;
  }
  /// Entries of axis N with itself and the columns behind it: the power of their wrenches along it. They go into one of
  /// two triangles only. Where two joints have the same coordinate, both triangles meet on the diagonal.
  template <int N, class C>
  int own_row(const columns& w, const C& c) const {
    const auto s = axis_of<N>(core, c);
    const int* rows = state.work.row_of_column.data();
    const int i = place.row + N;
    auto& m = matrix();
    S* column = &m(0, i);
    const std::size_t own = place.first + std::size_t{N};
    column[i] += as<S>(power(s, w.get(own)));
    for (std::size_t k = own + 1; k < place.last; ++k) {
      const S x = as<S>(power(s, w.get(k)));
      column[rows[k]] += rows[k] == i ? 2 * x : x;
    }
    return 0;
  }
  template <class X>
  void carry_columns(const X& x) const {
    const columns w(state.work);
    const std::size_t last = place.last;
    for (std::size_t k = place.first; k < last; ++k) w.set(k, transmit(x, w.get(k)));
  }
};

}  // namespace kte::detail
