#pragma once

#include <kte/dynamics/detail/bodies.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/tree/regressor.hpp>

#include <utility>

/// Inverse dynamics as linear function of the inertial parameters of the bodies, for their identification.
namespace kte {

namespace detail {

/// How many inertial parameters an element has.
template <class Core>
inline constexpr int parameter_count = is_rigid_body<Core> ? (Core::ports[0].what == kind::frame_2D ? 4 : 10)
                                       : has_mass<Core, double>&& Core::ports[0].what == kind::gen ? 1
                                                                                                   : 0;
/// The columns of the elements of a chain; at its end how many there are.
template <class Chain>
inline constexpr auto first_parameter = []<std::size_t... I>(std::index_sequence<I...>) {
  std::array<int, Chain::size + 1> first{parameter_count<core_of<Chain, I>>..., 0};
  int sum = 0;
  for (auto& f : first) f = std::exchange(sum, sum + f);
  return first;
}
(std::make_index_sequence<Chain::size>{});
template <class Chain>
inline constexpr int parameters_of = first_parameter<Chain>.back();

/// f<I>() for the elements of a chain, in order.
template <class Chain, class F>
KTE_INLINE constexpr void for_each_element(const F& f) {
  [&f]<std::size_t... I>(std::index_sequence<I...>) KTE_INLINE_LAMBDA {
    const int done[]{(f.template operator()<I>(), 0)..., 0};
    (void)done;
  }
  (std::make_index_sequence<Chain::size>{});
}

/// Matrices that are too large for the stack have their columns on the heap.
template <class S, int N, int P>
using regressor_matrix = Eigen::Matrix<S, N, sizeof(S) * N * P <= EIGEN_STACK_ALLOCATION_LIMIT ? P : Eigen::Dynamic>;

/// Every frame, joint and body once, by its type, in world axes; then a loop over numbers for each body. So what there
/// is to compile grows as the chain.
template <class S, class Chain, class Given>
class local_regressor {
  using types = local_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  static constexpr auto& plan = static_plan<Chain>;

 public:
  static constexpr int rows = plan.coordinates;
  using matrix_type = regressor_matrix<S, rows, parameters_of<Chain>>;

  KTE_INLINE local_regressor(const Chain& c, const Given& g, matrix_type& y) : chain_(c), motion_(c, g), y_(y) {
    y_.setZero(rows, parameters_of<Chain>);
    for_each_element<Chain>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template place<I>(); });
    for_each_element<Chain>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template add<I>(); });
    for_each_element<Chain>([this]<std::size_t I>()
                                KTE_INLINE_LAMBDA { this->template hand_on<Chain::size - 1 - I>(); });
  }

 private:
  template <std::size_t I, std::size_t P>
  KTE_INLINE constexpr decltype(auto) at_port() const {
    return motion_.template get<types::template what<I, P>, wiring::slot(I, P)>();
  }
  /// What a joint or link adds to the way of a frame, and the axes of a joint at its end.
  template <std::size_t I>
  KTE_INLINE void place() {
    if constexpr (is_transmission<core_t<I>>) {
      constexpr std::size_t base = coordinates_of<core_t<I>>;
      const auto& core = chain_.template core<I>();
      const auto step = [&](const auto& relative) KTE_INLINE_LAMBDA {
        step_[I] = as<S>(this->template at_port<I, base>().rotation * relative.position);
      };
      if constexpr (base == 0) {
        step(core.relative());
      } else {
        const auto& x = at_port<I, 0>();
        step(core.relative(position_only(x)));
        for_each_number<joint_dofs<core_t<I>>>([&]<int N>() KTE_INLINE_LAMBDA {
          const auto s = axis_of<N>(core, x);
          const auto& r = this->template at_port<I, base + 1>().rotation;
          axes_[plan.places[I].first + N] = {as<S>(r * s.velocity), as<S>(r * s.ang_velocity)};
        });
      }
    } else {
      static_assert(!has_output<core_t<I>> || !is_frame(core_t<I>::ports.back().what),
                    "kte: the regressor needs elements that move frames to be a kte::transmission");
    }
  }
  /// The columns of a body or mass.
  template <std::size_t I>
  KTE_INLINE void add() {
    if constexpr (parameter_count<core_t<I>> == 1) {
      y_(plan.row_of_gen[std::size_t{wiring::slot(I, 0)}], first_parameter<Chain>[I]) = as<S>(at_port<I, 0>().q_ddot);
    } else if constexpr (parameter_count<core_t<I>> > 0) {
      const auto& frame = at_port<I, 0>();
      tree::body_motion<S> x;
      x.ang_velocity = as<S>(frame.ang_velocity), x.ang_acceleration = as<S>(frame.ang_acceleration);
      x.acceleration = as<S>(frame.acceleration);
      add_body<parameter_count<core_t<I>>>(wiring::writer(types::template what<I, 0>, wiring::slot(I, 0)),
                                           as<S>(matrix(frame.rotation)), x, first_parameter<Chain>[I]);
    }
  }
  /// Of a body on the end of an element, in the axes R^T of its frame, as (1) of `jacobian`.
  template <int Count>
  void add_body(int element, const mat3<vec3<S>>& r, const tree::body_motion<S>& x, int first) {
    const mat3<vec3<S>> t = transpose(r);
    vec3<S> way{};
    for (; element >= 0; element = plan.places[static_cast<std::size_t>(element)].below) {
      const auto& at = plan.places[static_cast<std::size_t>(element)];
      for (int k = 0; k < at.axes; ++k) {
        const auto& s = axes_[at.first + static_cast<std::size_t>(k)];
        const vec3<S> v = t * (s.linear + cross(s.angular, way)), u = t * s.angular;
        const auto all = tree::power_by_parameters(x, v, u);
        for (int i = 0; i < Count; ++i) y_(at.row + k, first + i) += tree::parameter_at(all, i, Count);
      }
      way = step_[static_cast<std::size_t>(element)] + way;
    }
  }
  /// The row of a coordinate that follows another counts for that one too: q_end' = ratio q_base'.
  template <std::size_t I>
  KTE_INLINE void hand_on() {
    if constexpr (has_output<core_t<I>> && types::template output_kind<I> == kind::gen) {
      constexpr int base = plan.row_of_gen[std::size_t{wiring::slot(I, 0)}];
      constexpr int end = plan.row_of_gen[std::size_t{types::template output_slot<I>}];
      const S ratio = as<S>(chain_.template core<I>().doMotion(unit_rate<kind::gen, 0>(at_port<I, 0>())).q_dot);
      for (int i = 0; i < parameters_of<Chain>; ++i) y_(base, i) += ratio * y_(end, i);
    }
  }

  const Chain& chain_;
  const local_motion<Chain, Given> motion_;
  std::array<vec3<S>, Chain::size + 1> step_;               ///< from the base of an element to its end
  std::array<tree::world_axis<S>, plan.columns + 1> axes_;  ///< of all joints
  matrix_type& y_;
};

template <class S, class Chain, class At, class V, class A, class Base>
auto regressor_of(const Chain& c, const At& at, const V& v, const A& a, const Base& base) {
  static_assert(sizeof(check_loads_of<Chain>) > 0);
  at.check(), base.check();
  const given g{at, v, a, base};
  using pass = local_regressor<S, Chain, std::remove_const_t<decltype(g)>>;
  typename pass::matrix_type all;
  pass(c, g, all);
  const regressor_matrix<S, Chain::dofs, parameters_of<Chain>> y = all.topRows(Chain::dofs);
  check_result(y.data(), static_cast<std::size_t>(y.size()),
               [&]() KTE_INLINE_LAMBDA { blame<typename Chain::wiring>("a regressor", at.q, v, a, "a"); });
  return y;
}

}  // namespace detail

/// The inertial parameters pi of a chain, one body after the other in the order of its elements. An `inertia_3D` has
/// ten (of Pinocchio's `toDynamicParameters` in kind and order),
///
///   m,  m c_x, m c_y, m c_z,  I_xx, I_xy, I_yy, I_xz, I_yz, I_zz          (1)
///
/// with the inertia about the origin of the frame that it is fixed to, I = I_c + m (|c|^2 1 - c c^T), all in the axes
/// of that frame; kg, kg m, kg m^2. An `inertia_2D` has m, m c_x, m c_y, I_zz; an element with a mass on a coordinate
/// (`inertia_gen`) that mass. The kind of an element counts, not its numbers: a point mass has ten, too. Bodies that
/// are fixed to each other are not taken together.
template <class S = double, class Gravity, class... E>
auto inertial_parameters(const static_chain<Gravity, E...>& c) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  Eigen::Matrix<S, parameters_of<chain_type>, 1> pi;
  for_each_element<chain_type>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    constexpr int first = first_parameter<chain_type>[I], count = parameter_count<core_of<chain_type, I>>;
    if constexpr (count == 1) {
      pi[first] = as<S>(c.template core<I>().template mass<S>());
    } else if constexpr (count > 0) {
      const auto b = c.template core<I>().template mass<S>();
      const vec3<S> h = as<S>(b.moment);
      const sym3<S> j = as<S>(b.inertia);
      const tree::per_parameter<S> all{as<S>(b.mass), h.x, h.y, h.z, j.xx, j.xy, j.yy, j.xz, j.yz, j.zz};
      for (int i = 0; i < count; ++i) pi[first + i] = tree::parameter_at(all, i, count);
    }
  });
  return pi;
}

/// The regressor Y(q, v, a) of inverse dynamics, dofs x parameters (Atkeson, An, Hollerbach, Int. J. Robotics Research
/// 5(3), 1986; Siciliano et al., Robotics, 2009, section 7.2.2): with the pi of `inertial_parameters`
///
///   Y(q, v, a) pi = M(q) a + C(q, v) v + g(q)          (2)
///                 = inverse_dynamics(q, v, a) + Q(q, v)
///
/// with Q the forces of all elements that have no inertial parameters: springs, dampers, actuators. Y does not depend
/// on pi, only on joints, links and where the bodies are; the chain's `gravity()` is in it. Row and column of a
/// coordinate and a parameter hold the force on the one for a unit of the other: for a body in whose frame the rate of
/// the coordinate makes the velocity v, u (its Jacobian),
///
///   v . (m a + al x h + w x (w x h)) + u . (I al + w x I w + h x a),   h = m c          (3)
///
/// q, v, a as for `inverse_dynamics`, bases at rest. No heap, unless the matrix is larger than
/// EIGEN_STACK_ALLOCATION_LIMIT.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
auto torque_regressor(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  check_configuration<chain_type>(q), check_velocities<chain_type>(v);
  check_rates<chain_type>(a, "a", "an acceleration");
  const configuration<S, typename chain_type::wiring, Q> at(q);
  return regressor_of<S>(c, at, each<S, V>{v}, each<S, A>{a},
                         same_base{motion{skip{}, no_rotation{}, skip{}, zero3{}, -c.gravity(), zero3{}}});
}

/// The same at the positions, rates and accelerations of a state, with its moving bases.
template <class Gravity, class... E, class S>
auto torque_regressor(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using namespace detail;
  using state = chain_state<S, wiring<E...>>;
  const auto q = positions(s);
  const auto v = velocities(s), a = accelerations(s);
  using vector = std::remove_const_t<decltype(v)>;
  const configuration<S, wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return regressor_of<S>(c, at, each<S, vector>{v}, each<S, vector>{a}, base_of_state<state>{s});
}

}  // namespace kte
