#pragma once

#include <kte/dynamics/detail/given.hpp>
#include <kte/kernels/joint.hpp>
#include <kte/math/dual.hpp>

/// Derivatives of the forces that elements put on generalized coordinates: springs, dampers, masses.
namespace kte::detail {

/// Whether an element sees coordinates and inputs only.
template <class Core>
inline constexpr bool is_on_coordinates = [] {
  for (const auto& p : Core::ports)
    if (p.what != kind::gen && p.what != kind::input) return false;
  return true;
}();

template <class S, class Chain, class Given>
class coordinate_derivatives {
  using types = local_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  using matrix = joint_matrix<S, Chain::dofs>;
  using number = dual<S, 3>;  // by q, v, a of one coordinate

 public:
  const Chain& chain;
  const Given& given;
  matrix &by_q, &by_v, &by_a;

  /// Subtracts the derivatives of the forces of all such elements: tau is what they do not give.
  KTE_INLINE void subtract() const { elements(std::make_index_sequence<Chain::size>{}); }

 private:
  template <std::size_t... I>
  KTE_INLINE void elements(std::index_sequence<I...>) const {
    const int done[]{(element<I>(), 0)..., 0};
    (void)done;
  }
  template <std::size_t I>
  KTE_INLINE void element() const {
    using core = typename types::template core<I>;
    if constexpr (is_on_coordinates<core>) ports<I>(std::make_index_sequence<port_count<core>>{});
  }
  template <std::size_t I, std::size_t... P>
  KTE_INLINE void ports(std::index_sequence<P...> all) const {
    const int done[]{(by_port<I, P>(all), 0)..., 0};
    (void)done;
  }
  template <std::size_t I, std::size_t P>
  static constexpr bool free =
      types::template what<I, P> == kind::gen&& wiring::template is_free<kind::gen, wiring::slot(I, P)>;
  template <std::size_t I, std::size_t P>
  static constexpr int row = wiring::template at<kind::gen, wiring::slot(I, P)>.v;

  /// By the coordinate at port L.
  template <std::size_t I, std::size_t L, std::size_t... P>
  KTE_INLINE void by_port(std::index_sequence<P...>) const {
    if constexpr (free<I, L>) {
      const auto loads = chain.template core<I>().doForce(seen<I, P, L>()...);
      const int done[]{(put<I, P, L>(loads), 0)...};
      (void)done;
    }
  }
  template <std::size_t I, std::size_t P, std::size_t L>
  KTE_INLINE auto seen() const {
    constexpr kind k = types::template what<I, P>;
    const auto c = types::template given<k, wiring::slot(I, P)>(given);
    if constexpr (k != kind::gen) {
      return c;
    } else {
      constexpr int on = wiring::slot(I, P) == wiring::slot(I, L);
      const auto variable_of = [](const auto& x, int i) KTE_INLINE_LAMBDA {
        number n(as<S>(x));
        if (i >= 0) n.derivative[static_cast<std::size_t>(i)] = S(1);
        return n;
      };
      if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(c.cos)>, skip>) {
        number cosine(as<S>(c.cos)), sine(as<S>(c.sin));
        cosine.derivative[0] = S(-on) * as<S>(c.sin), sine.derivative[0] = S(on) * as<S>(c.cos);
        return coordinate{variable_of(c.q, on - 1), variable_of(c.q_dot, 2 * on - 1), variable_of(c.q_ddot, 3 * on - 1),
                          cosine, sine};
      } else {
        return coordinate{variable_of(c.q, on - 1), variable_of(c.q_dot, 2 * on - 1), variable_of(c.q_ddot, 3 * on - 1),
                          skip{}, skip{}};
      }
    }
  }
  template <std::size_t I, std::size_t P, std::size_t L, class Loads>
  KTE_INLINE void put(const Loads& loads) const {
    if constexpr (free<I, P>) {
      const auto& f = boost::hana::at_c<load_index<typename types::template core<I>, P>>(loads);
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(f)>, number>) {  // else it depends on no coordinate
        by_q(row<I, P>, row<I, L>) -= f.derivative[0];
        by_v(row<I, P>, row<I, L>) -= f.derivative[1];
        by_a(row<I, P>, row<I, L>) -= f.derivative[2];
      }
    }
  }
};

}  // namespace kte::detail
