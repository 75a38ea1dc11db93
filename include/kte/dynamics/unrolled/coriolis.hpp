#pragma once

#include <kte/dynamics/unrolled/regressor.hpp>
#include <kte/tree/coriolis.hpp>

/// The Coriolis matrix of static chains that are trees of joints.
namespace kte::detail {

/// The joints of a chain, in order: the element of each, and the joint or base on which it is.
template <class Chain>
struct joints_of {
  static constexpr auto& steps = tree_steps<Chain>;
  static constexpr std::size_t count = [] {
    std::size_t n = 0;
    for (std::size_t e = 0; e < Chain::size; ++e) n += steps[e].axes > 0;
    return n;
  }();
  /// The joint that carries an element, or is the element; -1: a base.
  static constexpr auto joint_at = [] {
    std::array<int, Chain::size + 1> at{};
    int joints = 0;
    for (std::size_t e = 0; e < Chain::size; ++e) {
      const int below = steps[e].below;
      at[e] = steps[e].axes > 0 ? joints++ : below < 0 ? -1 : at[static_cast<std::size_t>(below)];
    }
    return at;
  }();
  static constexpr auto element = [] {
    std::array<std::size_t, count + 1> e{};
    for (std::size_t i = Chain::size; i-- > 0;)
      if (steps[i].axes > 0) e[static_cast<std::size_t>(joint_at[i])] = i;
    return e;
  }();
};
/// The joints in the form that tree/coriolis.hpp reads.
template <class S, class Chain>
struct joints_as_tree {
  using joints = joints_of<Chain>;
  const std::array<vec3<S>, joints::count + 1>& way;

  static constexpr const tree_step& at(int i) { return joints::steps[joints::element[static_cast<std::size_t>(i)]]; }
  static constexpr int count() { return static_cast<int>(joints::count); }
  static constexpr int parent(int i) { return at(i).below < 0 ? -1 : joints::joint_at[std::size_t(at(i).below)]; }
  static constexpr int first(int i) { return static_cast<int>(at(i).first); }
  static constexpr int axes(int i) { return at(i).axes; }
  const vec3<S>& step(int i) const { return way[static_cast<std::size_t>(i)]; }
};

/// Evaluates every frame, joint and body once, by type; then loops over numbers.
template <class S, class Chain, class Given>
class unrolled_coriolis {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  using joints = joints_of<Chain>;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  static constexpr auto& steps = tree_steps<Chain>;
  static constexpr std::size_t axes = steps[Chain::size].first;
  /// The row of each axis.
  static constexpr auto row = [] {
    std::array<int, axes + 1> rows{};
    for (std::size_t e = 0; e < Chain::size; ++e)
      for (std::size_t n = 0; n < static_cast<std::size_t>(steps[e].axes); ++n)
        rows[steps[e].first + n] = steps[e].row[n];
    return rows;
  }();

 public:
  KTE_INLINE unrolled_coriolis(const Chain& c, const Given& g) : chain_(c), motion_(c, g) {}

  KTE_INLINE auto result() {
    joint_matrix<S, Chain::dofs> m;
    m.setZero();
    for_each_element<Chain>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template place<I>(); });
    tree::coriolis_terms(joints_as_tree<S, Chain>{way_}, axes_.data(), changes_.data(), bodies_.data(),
                         [&m](int j, int k, const S& c_jk, const S&) KTE_INLINE_LAMBDA {
                           const int to = row[static_cast<std::size_t>(j)], by = row[static_cast<std::size_t>(k)];
                           if (to < Chain::dofs && by < Chain::dofs) m(to, by) = c_jk;  // otherwise prescribed
                         });
    return m;
  }

 private:
  template <std::size_t I, std::size_t P>
  KTE_INLINE constexpr decltype(auto) at_port() const {
    return motion_.template get<types::template what<I, P>, wiring::slot(I, P)>();
  }
  /// The inertia fixed to a frame, without the bodies that joints move.
  template <kind K, int Slot, std::size_t... N>
  KTE_INLINE constexpr auto fixed_to(std::index_sequence<N...>) const {
    return (no_mass + ... + part<loads_on<wiring, K, Slot>[N].element>());
  }
  template <kind K, int Slot>
  KTE_INLINE constexpr auto fixed_to() const {
    return fixed_to<K, Slot>(std::make_index_sequence<loads_on<wiring, K, Slot>.size()>{});
  }
  template <std::size_t I>
  KTE_INLINE constexpr auto part() const {
    if constexpr (is_body<core_t<I>>) {
      return chain_.template core<I>().template mass<S>();
    } else if constexpr (is_transmission<core_t<I>> && steps[I].axes == 0) {
      const auto x = chain_.template core<I>().relative();
      return transported(x.rotation, x.position,
                         fixed_to<types::template output_kind<I>, types::template output_slot<I>>());
    } else {
      return no_mass;
    }
  }
  /// From the previous joint or base to the end of element I, in axes of the world.
  template <int I>
  KTE_INLINE constexpr auto way_to() const {
    constexpr std::size_t e{I}, base = port_count<core_t<e>> - 2;
    const auto own = at_port<e, base>().rotation * motion_.template joint_pose<e>().position;
    if constexpr (steps[e].below >= 0 && steps[std::size_t(steps[e].below < 0 ? 0 : steps[e].below)].axes == 0) {
      return way_to<steps[e].below>() + own;
    } else {
      return own;
    }
  }
  template <std::size_t I>
  KTE_INLINE void place() {
    if constexpr (steps[I].axes > 0) {
      constexpr std::size_t j{joints::joint_at[I]};
      const auto& end = at_port<I, 2>();
      const mat3<vec3<S>> r = as<S>(matrix(end.rotation));
      const vec3<S> v = as<S>(r * end.velocity), w = as<S>(r * end.ang_velocity);
      const auto own = fixed_to<types::template output_kind<I>, types::template output_slot<I>>();
      way_[j] = as<S>(way_to<int{I}>());
      bodies_[j] =
          tree::coriolis_of<S>({as<S>(own.mass), as<S>(r * own.moment), as<S>(congruence(r, own.inertia))}, v, w);
      for_each_number<joint_dofs<core_t<I>>>([&]<int N>() KTE_INLINE_LAMBDA {
        const auto s = motion_.template joint_axis<I, N>();
        const std::size_t k = steps[I].first + std::size_t{N};
        axes_[k] = {as<S>(r * s.velocity), as<S>(r * s.ang_velocity)};
        changes_[k] = tree::change_of(axes_[k], v, w);
      });
    } else if constexpr (!is_transmission<core_t<I>>) {
      static_assert(sizeof(pass_over<Chain, I>) > 0);
    }
  }

  const Chain& chain_;
  const unrolled_motion<Chain, Given> motion_;
  // For joints and axes; one more than their number, so that the arrays are not empty.
  std::array<vec3<S>, joints::count + 1> way_;
  std::array<tree::world_axis<S>, axes + 1> axes_, changes_;
  std::array<tree::coriolis_body<S>, joints::count + 1> bodies_;
};

}  // namespace kte::detail
