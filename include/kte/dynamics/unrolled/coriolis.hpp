#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/joints.hpp>
#include <kte/recursions/coriolis.hpp>

/// The Coriolis matrix of static chains that are trees of joints.
namespace kte::detail {

/// The Coriolis matrix of a chain of joints and links.
template <class S, class Chain, class Given>
class unrolled_coriolis {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  using joints = unrolled_joints<S, Chain, Given>;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

 public:
  KTE_INLINE unrolled_coriolis(const Chain& c, const Given& g) : chain_(c), joints_(c, g) {}

  KTE_INLINE auto result() {
    joint_matrix<S, Chain::dofs> m;
    m.setZero();
    unroll<Chain::size>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template add<I>(); });
    engine::coriolis_terms(
        joints_, changes_.data(), bodies_.data(), [&m](int j, int k, const S& c_jk, const S&) KTE_INLINE_LAMBDA {
          const int to = joints::row[static_cast<std::size_t>(j)], by = joints::row[static_cast<std::size_t>(k)];
          if (to < Chain::dofs && by < Chain::dofs) m(to, by) = c_jk;  // otherwise prescribed
        });
    return m;
  }

 private:
  /// The inertia fixed to a frame, without the bodies that joints move.
  template <kind K, int Slot>
  KTE_INLINE constexpr auto fixed_to() const {
    return [this]<std::size_t... N>(std::index_sequence<N...>) KTE_INLINE_LAMBDA {
      return (no_mass + ... + this->template part<loads_on<wiring, K, Slot>[N].element>());
    }
    (std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }
  template <std::size_t I>
  KTE_INLINE constexpr auto part() const {
    if constexpr (is_body<core_t<I>>) {
      return chain_.template core<I>().template mass<S>();
    } else if constexpr (is_transmission<core_t<I>> && tree_steps<Chain>[I].axes == 0) {
      const auto x = chain_.template core<I>().relative();
      return transported(x.rotation, x.position,
                         fixed_to<types::template output_kind<I>, types::template output_slot<I>>());
    } else {
      return no_mass;
    }
  }
  /// The body at the end of joint I.
  template <std::size_t I>
  KTE_INLINE void add() {
    constexpr auto& step = tree_steps<Chain>[I];
    if constexpr (step.axes > 0) {
      constexpr std::size_t j{joints_of<Chain>::joint_at[I]};
      const auto& end = joints_.template at_port<I, port_count<core_t<I>> - 1>();
      const mat3<vec3<S>> r = as<S>(matrix(end.rotation));
      const vec3<S> v = as<S>(r * end.velocity), w = as<S>(r * end.ang_velocity);
      const auto own = fixed_to<types::template output_kind<I>, types::template output_slot<I>>();
      bodies_[j] =
          engine::coriolis_of<S>({as<S>(own.mass), as<S>(r * own.moment), as<S>(congruence(r, own.inertia))}, v, w);
      for (std::size_t k = step.first; k < step.first + static_cast<std::size_t>(step.axes); ++k)
        changes_[k] = engine::change_of(joints_.axis(static_cast<int>(k)), v, w);
    }
  }

  const Chain& chain_;
  const joints joints_;
  // One more than needed, so that the arrays are not empty.
  std::array<engine::joint_axis<S>, joints::all_axes + 1> changes_;
  std::array<engine::coriolis_body<S>, joints_of<Chain>::count + 1> bodies_;
};

}  // namespace kte::detail
