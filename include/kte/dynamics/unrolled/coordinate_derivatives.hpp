#pragma once

#include <kte/contract/coordinate_variation.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/given.hpp>

/// Derivatives of the forces of elements on generalized coordinates: springs, dampers, masses.
namespace kte::detail {

template <class S, class Chain, class Given>
class coordinate_derivatives {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  using matrix = joint_matrix<S, Chain::dofs>;

 public:
  const Chain& chain;
  const Given& given;
  matrix &by_q, &by_v, &by_a;

  /// Subtracts the derivatives of these forces, because tau is the force that elements do not provide.
  KTE_INLINE void subtract() const {
    unroll<Chain::size>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template element<I>(); });
  }

 private:
  template <std::size_t I>
  KTE_INLINE void element() const {
    using core = typename types::template core<I>;
    if constexpr (is_on_coordinates<core>)
      unroll<port_count<core>>([this]<std::size_t P>() KTE_INLINE_LAMBDA {
        this->template by_port<I, P>(std::make_index_sequence<port_count<core>>{});
      });
  }
  template <std::size_t I, std::size_t P>
  static constexpr bool free =
      types::template what<I, P> == kind::gen&& wiring::template is_free<kind::gen, wiring::slot(I, P)>;
  template <std::size_t I, std::size_t P>
  static constexpr int row = wiring::template at<kind::gen, wiring::slot(I, P)>.v;

  /// Whether port L has the coordinate of an earlier port; `seen` then varies both together.
  template <std::size_t I, std::size_t L>
  static constexpr bool is_again() {
    for (std::size_t before = 0; before < L; ++before)
      if (types::template core<I>::ports[before].what == kind::gen && wiring::slot(I, before) == wiring::slot(I, L))
        return true;
    return false;
  }
  /// Derivatives by the coordinate at port L.
  template <std::size_t I, std::size_t L, std::size_t... P>
  KTE_INLINE void by_port(std::index_sequence<P...>) const {
    if constexpr (free<I, L> && !is_again<I, L>()) {
      const auto loads = chain.template core<I>().doForce(seen<I, P, L>()...);
      const int done[]{(put<I, P, L>(loads), 0)...};
      (void)done;
    }
  }
  template <std::size_t I, std::size_t P, std::size_t L>
  KTE_INLINE auto seen() const {
    constexpr kind k = types::template what<I, P>;
    constexpr int slot = wiring::slot(I, P);
    if constexpr (k == kind::gen) {
      return varied_coordinate<S>(types::template given<k, slot>(given), slot == wiring::slot(I, L));
    } else {
      return types::template given<k, slot>(given);
    }
  }
  template <std::size_t I, std::size_t P, std::size_t L, class Loads>
  KTE_INLINE void put(const Loads& loads) const {
    if constexpr (free<I, P>)
      subtract_variation<S>(nth<load_index<typename types::template core<I>, P>>(loads), by_q, by_v, by_a, row<I, P>,
                            row<I, L>);
  }
};

}  // namespace kte::detail
