#pragma once

#include <kte/contract/port.hpp>

#include <array>
#include <vector>

/// Dependencies in a chain other than those of joints and links.
namespace kte::detail {

/// When a quantity is known.
enum class level : unsigned char {
  given,        ///< external, or a function of external quantities
  coordinates,  ///< a function of the degrees of freedom
  bodies        ///< known after bodies are placed
};

template <template <class> class List>
struct dependencies {
  std::array<List<level>, kinds> of;  ///< of items, by kind
  List<char> matters;                 ///< for each element: whether a force depends on it

  constexpr level at(kind k, int i) const { return of[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)]; }
};

/// `Chain`: as for `arrange` (tree/plan.hpp).
template <template <class> class List, class Chain>
constexpr dependencies<List> dependencies_of(const Chain& c) {
  const auto slot = [](auto& list, kind k, int i) -> auto& {
    return list[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
  };
  dependencies<List> d;
  std::array<List<char>, kinds> wanted;
  for (std::size_t k = 0; k < kinds; ++k) {
    const auto n = static_cast<std::size_t>(c.count(static_cast<kind>(k)));
    d.of[k].resize(n), wanted[k].resize(n);
    for (std::size_t i = 0; i < n; ++i) d.of[k][i] = level::given, wanted[k][i] = 0;
  }
  for (std::size_t f = 0; f < c.freedoms(); ++f)
    slot(d.of, c.freedom_at(f).what, c.freedom_at(f).slot) = level::coordinates;
  for (std::size_t e = 0; e < c.elements(); ++e) {
    const auto ports = c.ports(e);
    const std::size_t last = ports.size() - 1;
    if (ports[last].how != access::out) continue;
    level l = c.rigid(e) ? level::bodies : level::given;
    for (std::size_t p = 0; p < last; ++p)
      if (const level input = slot(d.of, ports[p].what, c.index(e, p)); input > l) l = input;
    slot(d.of, ports[last].what, c.index(e, last)) = l;
  }
  d.matters.resize(c.elements());
  for (std::size_t e = c.elements(); e-- > 0;) {
    const auto ports = c.ports(e);
    const port& last = ports.back();
    const bool may_not = last.how == access::out && !c.rigid(e) && !is_coordinate(last.what);
    d.matters[e] = !may_not || slot(wanted, last.what, c.index(e, ports.size() - 1));
    if (d.matters[e])
      for (std::size_t p = 0; p < ports.size(); ++p) slot(wanted, ports[p].what, c.index(e, p)) = 1;
  }
  return d;
}

}  // namespace kte::detail
