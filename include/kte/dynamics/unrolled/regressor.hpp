#pragma once

#include <kte/dynamics/unrolled/given_bases.hpp>
#include <kte/tree/regressor.hpp>

#include <utility>

/// The regressor of static chains.
namespace kte::detail {

/// The number of inertial parameters of an element.
template <class Core>
inline constexpr int parameter_count = Core::ports[0].what == kind::gen        ? has_mass<Core, double>
                                       : !is_rigid_body<Core>                  ? 0
                                       : Core::ports[0].what == kind::frame_2D ? 4
                                                                               : 10;
/// The first column of each element of a chain, and at the end the number of columns.
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

/// Calls f<I>() for the elements of a chain, in order.
template <class Chain, class F>
KTE_INLINE constexpr void for_each_element(const F& f) {
  [&f]<std::size_t... I>(std::index_sequence<I...>) KTE_INLINE_LAMBDA {
    const int done[]{(f.template operator()<I>(), 0)..., 0};
    (void)done;
  }
  (std::make_index_sequence<Chain::size>{});
}

/// A joint or link: the element whose end is its base, or -1; the number of its first axis among all axes; the rows of
/// its coordinates.
struct tree_step {
  int below = -1, axes = 0;
  std::array<int, 6> row{};
  std::size_t first = 0;
};
template <class Chain>
inline constexpr auto tree_steps = [] {
  std::array<tree_step, Chain::size + 1> steps{};  // the last has the number of all axes
  const static_connections<Chain> c;
  for (std::size_t e = 0; e < Chain::size; ++e) {
    auto& x = steps[e];
    steps[e + 1].first = x.first;
    if (!c.rigid(e)) continue;
    const auto ports = c.ports(e);
    const std::size_t base = ports.size() - 2;
    x.below = c.writer(ports[base].what, c.index(e, base));
    if (base > 0 && ports[0].what != kind::gen) {
      x.axes = nv_of(ports[0].what);
      for (int k = 0; k < x.axes; ++k) x.row[static_cast<std::size_t>(k)] = static_plan<Chain>.joint_row[e] + k;
    }
    for (std::size_t k = 0; ports[k].what == kind::gen; ++k)
      x.row[k] = static_plan<Chain>.row_of_gen[static_cast<std::size_t>(c.index(e, k))], ++x.axes;
    steps[e + 1].first += static_cast<std::size_t>(x.axes);
  }
  return steps;
}();

/// Whether matrices fit on the stack; larger ones have their columns on the heap. (Limit 0: none.)
template <int N, int P, class S>
inline constexpr bool fits_on_stack = EIGEN_STACK_ALLOCATION_LIMIT == 0 ||
                                      sizeof(S) * N* P <= EIGEN_STACK_ALLOCATION_LIMIT;
template <class S, int N, int P>
using regressor_matrix = Eigen::Matrix<S, N, fits_on_stack<N, P, S> ? P : Eigen::Dynamic>;

/// Computes every frame, joint and body once, by its type, in world axes, and then for each body a loop over numbers,
/// because a chain of n bodies has n^2 / 2 pairs of joint and body.
template <class S, class Chain, class Given>
class unrolled_regressor {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  static constexpr auto& plan = static_plan<Chain>;
  static constexpr auto& steps = tree_steps<Chain>;

 public:
  static constexpr int rows = plan.coordinates;
  using matrix_type = regressor_matrix<S, rows, parameters_of<Chain>>;

  KTE_INLINE unrolled_regressor(const Chain& c, const Given& g, matrix_type& y) : chain_(c), motion_(c, g), y_(y) {
    y_.setZero(rows, parameters_of<Chain>);
    for_each_element<Chain>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template place<I>(); });
    for_each_element<Chain>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template add<I>(); });
    for_each_element<Chain>([this]<std::size_t I>()
                                KTE_INLINE_LAMBDA { this->template pull_back<Chain::size - 1 - I>(); });
  }

 private:
  template <std::size_t I, std::size_t P>
  KTE_INLINE constexpr decltype(auto) at_port() const {
    return motion_.template get<types::template what<I, P>, wiring::slot(I, P)>();
  }
  /// Adds a joint or link to the path of a frame, and the axes of a joint at its end.
  template <std::size_t I>
  KTE_INLINE void place() {
    if constexpr (is_transmission<core_t<I>>) {
      constexpr std::size_t base = port_count<core_t<I>> - 2;
      step_[I] = as<S>(at_port<I, base>().rotation * motion_.template joint_pose<I>().position);
      if constexpr (base > 0)
        for_each_number<joint_dofs<core_t<I>>>([&]<int N>() KTE_INLINE_LAMBDA {
          const auto s = motion_.template joint_axis<I, N>();
          const auto& r = this->template at_port<I, base + 1>().rotation;
          axes_[steps[I].first + N] = {as<S>(r * s.velocity), as<S>(r * s.ang_velocity)};
        });
    } else {
      static_assert(sizeof(pass_over<Chain, I>) > 0);
      step_[I] = {};
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
  /// Adds the columns of a body at the end of an element, in the axes R^T of its frame, as in (1) of `jacobian`.
  template <int Count>
  void add_body(int element, const mat3<vec3<S>>& r, const tree::body_motion<S>& x, int first) {
    const mat3<vec3<S>> t = transpose(r);
    vec3<S> way{};
    for (; element >= 0; element = steps[static_cast<std::size_t>(element)].below) {
      const auto& at = steps[static_cast<std::size_t>(element)];
      for (int k = 0; k < at.axes; ++k) {
        const auto& s = axes_[at.first + static_cast<std::size_t>(k)];
        const vec3<S> v = t * (s.linear + cross(s.angular, way)), u = t * s.angular;
        const auto all = tree::power_by_parameters(x, v, u);
        for (int i = 0; i < Count; ++i)
          y_(at.row[static_cast<std::size_t>(k)], first + i) += tree::parameter_at(all, i, Count);
      }
      way = step_[static_cast<std::size_t>(element)] + way;
    }
  }
  /// Adds the row of a dependent coordinate to that of its leading coordinate: q_end' = ratio q_base'.
  template <std::size_t I>
  KTE_INLINE void pull_back() {
    if constexpr (has_output<core_t<I>> && core_t<I>::ports[0].what == kind::gen &&
                  types::template output_kind<I> == kind::gen) {
      constexpr int base = plan.row_of_gen[std::size_t{wiring::slot(I, 0)}];
      constexpr int end = plan.row_of_gen[std::size_t{types::template output_slot<I>}];
      const S ratio = as<S>(chain_.template core<I>().doMotion(unit_rate<kind::gen, 0>(at_port<I, 0>())).q_dot);
      for (int i = 0; i < parameters_of<Chain>; ++i) y_(base, i) += ratio * y_(end, i);
    }
  }

  const Chain& chain_;
  const unrolled_motion<Chain, Given> motion_;
  std::array<vec3<S>, Chain::size + 1> step_;                           ///< by element: from its base to its end
  std::array<tree::world_axis<S>, steps[Chain::size].first + 1> axes_;  ///< of all joints
  matrix_type& y_;
};

template <class S, class Chain, class At, class V, class A, class Base>
auto regressor_of(const Chain& c, const At& at, const V& v, const A& a, const Base& base) {
  static_assert(sizeof(check_loads_of<Chain>) > 0 && sizeof(check_bodies_of<Chain>) > 0 &&
                sizeof(check_closures_of<Chain>) > 0);
  at.check(), base.check();
  const given g{at, v, a, base};
  using pass = unrolled_regressor<S, Chain, std::remove_const_t<decltype(g)>>;
  typename pass::matrix_type y;
  pass(c, g, y);
  check_result(y.data(), static_cast<std::size_t>(y.size()),
               [&]() KTE_INLINE_LAMBDA { diagnose<typename Chain::wiring>("a regressor", at.q, v, a, "a"); });
  if constexpr (pass::rows == Chain::dofs) {
    return y;
  } else {
    return regressor_matrix<S, Chain::dofs, parameters_of<Chain>>(y.topRows(Chain::dofs));
  }
}

}  // namespace kte::detail
