#pragma once

#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/detail/columns.hpp>

namespace kte::detail {

/// Composite inertias from the tips to the bases, and at each axis of a joint the momentum that its unit rate makes, in
/// axes of the bases and about a point, as a column.
template <class S, class Chain, class Given>
class local_momenta : columns<S, Chain, Given> {
  using base = columns<S, Chain, Given>;
  using typename base::types;
  using typename base::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

 public:
  using typename base::matrix_type;

  KTE_INLINE local_momenta(const Chain& c, const Given& g, const vec3<S>& point, matrix_type& m)
      : base(c, g, m), chain_(c) {
    from_bases<kind::frame_2D>(point, std::make_integer_sequence<int, wiring::count(kind::frame_2D)>{});
    from_bases<kind::frame_3D>(point, std::make_integer_sequence<int, wiring::count(kind::frame_3D)>{});
    from_given_bases(point, typename given_bases<Chain>::type{});
  }

 private:
  template <kind K, int... Slot>
  KTE_INLINE constexpr void from_bases(const vec3<S>& point, std::integer_sequence<int, Slot...>) {
    const int done[]{(from_base<K, Slot>(point), 0)..., 0};
    (void)done;
  }
  template <kind K, int Slot>
  KTE_INLINE constexpr void from_base(const vec3<S>& point) {
    if constexpr (wiring::writer(K, Slot) < 0)
      (void)carried<K, Slot>(pose{no_rotation{}, -point}, std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }
  template <std::size_t... I>
  KTE_INLINE constexpr void from_given_bases(const vec3<S>& point, std::index_sequence<I...>) {
    const int done[]{(from_given_base<types::template output_kind<I>, types::template output_slot<I>>(point), 0)..., 0};
    (void)done;
  }
  template <kind K, int Slot>
  KTE_INLINE constexpr void from_given_base(const vec3<S>& point) {
    const auto x = this->template motion_of_frame<K, Slot>();
    (void)carried<K, Slot>(pose{x.rotation, x.position - point},
                           std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }
  /// What a frame carries that stands at x, seen from the point.
  template <kind K, int Slot, class X, std::size_t... N>
  KTE_INLINE constexpr auto carried(const X& x, std::index_sequence<N...>) {
    return (no_mass + ... + part<loads_on<wiring, K, Slot>[N].element>(x));
  }
  template <std::size_t I, class X>
  KTE_INLINE constexpr auto part(const X& x) {
    if constexpr (is_body<core_t<I>>) {
      return chain_.template core<I>().template mass<S>();
    } else if constexpr (is_transmission<core_t<I>>) {
      constexpr kind k = types::template output_kind<I>;
      constexpr int slot = types::template output_slot<I>;
      const auto relative = this->template pose_of_element<I>();
      const auto end = compose(x, relative);
      const auto b = carried<k, slot>(end, std::make_index_sequence<loads_on<wiring, k, slot>.size()>{});
      base::template for_each_axis<I>([&]<int N>() KTE_INLINE_LAMBDA {
        const auto h = transmit(end, accelerating_wrench(b, this->template axis<I, N>()));
        this->template put<I, N>(h.force, h.torque);  // (2)
      });
      return transported(relative.rotation, relative.position, b);
    } else {
      static_assert(sizeof(pass_over<Chain, I>) > 0);
      return no_mass;
    }
  }

  const Chain& chain_;
};

}  // namespace kte::detail
