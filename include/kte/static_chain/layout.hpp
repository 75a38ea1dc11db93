#pragma once

#include <kte/static_chain/static_chain.hpp>

#include <ostream>

/// The positions of the coordinates of a chain in its vectors q and v.
namespace kte {

/// The coordinate `name` of the kind `what`: q[q .. q + nq) of a configuration, v[v .. v + nv) of velocities,
/// accelerations and forces.
///   number         q; v
///   rotation       w, x, y, z of the quaternion; w of the moving frame, in its axes
///   pose in space  x, y, z, then the quaternion; v, then w of the moving frame, in its axes
///   pose in plane  x, y, angle; v_x, v_y, w, in the axes of the moving frame
template <class Name = std::string_view>
struct layout_entry {
  Name name;
  kind what;
  int q, nq;
  int v, nv;
  template <class Other>
  constexpr bool operator==(const layout_entry<Other>& o) const {
    return std::string_view(name) == std::string_view(o.name) && what == o.what && q == o.q && nq == o.nq && v == o.v &&
           nv == o.nv;
  }
};

namespace detail {
/// The names at all ports of a chain, in order.
template <class Wiring, class... E>
constexpr auto names_at_ports() {
  std::array<std::string_view, Wiring::ports + 1> names{};
  std::size_t p = 0;
  const auto append = [&]<class Core, class... Keys>(const element<Core, Keys...>*) {
    const std::string_view own[]{Keys::name...};
    for (const auto& n : own) names[p++] = n;
    return 0;
  };
  const int done[]{append(static_cast<const E*>(nullptr))..., 0};
  (void)done;
  return names;
}
template <class Wiring, class... E>
constexpr auto layout_of() {
  std::array<layout_entry<>, Wiring::freedoms> table{};
  const auto names = names_at_ports<Wiring, E...>();
  for (std::size_t i = 0; i < table.size(); ++i) {
    const freedom& f = Wiring::table.free[i];
    for (std::size_t port = Wiring::ports; port-- > 0;)
      if (Wiring::table.what[port] == f.what && Wiring::table.slot[port] == f.slot) table[i].name = names[port];
    table[i] = {table[i].name, f.what, f.q, nq_of(f.what), f.v, nv_of(f.what)};
  }
  return table;
}
}  // namespace detail

/// The layout of a static chain: a table known at compile time, in the order of q and v.
template <class Gravity, class... E>
[[nodiscard]] constexpr auto layout(const static_chain<Gravity, E...>&) {
  constexpr auto table = detail::layout_of<detail::wiring<E...>, E...>();
  return table;
}

/// One line per coordinate: "trunk  3D pose  q[0..6]  v[0..5]".
template <class Table>
requires requires { Table::value_type::nq; }
std::ostream& print(std::ostream& out, const Table& table) {
  const auto range = [&out](char vector, int first, int n) {
    out << "  " << vector << '[' << first;
    if (n > 1) out << ".." << first + n - 1;
    out << ']';
  };
  for (const auto& e : table) {
    out << e.name << "  " << to_string(e.what);
    range('q', e.q, e.nq), range('v', e.v, e.nv);
    out << '\n';
  }
  return out;
}

}  // namespace kte
