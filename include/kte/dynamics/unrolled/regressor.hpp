#pragma once

#include <kte/contract/element_numbers.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/joints.hpp>
#include <kte/recursions/regressor.hpp>

/// The regressor of static chains.
namespace kte::detail {

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

/// Whether matrices fit on the stack; larger ones have their columns on the heap. (Limit 0: none.)
template <int N, int P, class S>
inline constexpr bool fits_on_stack = EIGEN_STACK_ALLOCATION_LIMIT == 0 ||
                                      sizeof(S) * N* P <= EIGEN_STACK_ALLOCATION_LIMIT;
template <class S, int N, int P>
using regressor_matrix = Eigen::Matrix<S, N, fits_on_stack<N, P, S> ? P : Eigen::Dynamic>;

/// The columns of bodies and masses, one after the other.
template <class S, class Chain, class Given>
class unrolled_regressor {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  using joints = unrolled_joints<S, Chain, Given>;
  static constexpr auto& plan = static_plan<Chain>;

 public:
  static constexpr int rows = plan.coordinates;
  using matrix_type = regressor_matrix<S, rows, parameters_of<Chain>>;

  KTE_INLINE unrolled_regressor(const Chain& c, const Given& g, matrix_type& y) : chain_(c), joints_(c, g), y_(y) {
    y_.setZero(rows, parameters_of<Chain>);
    unroll<Chain::size>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template add<I>(); });
    unroll<Chain::size>([this]<std::size_t I>() KTE_INLINE_LAMBDA { this->template pull_back<Chain::size - 1 - I>(); });
  }

 private:
  template <std::size_t I>
  KTE_INLINE void add() {
    constexpr int count = parameter_count<core_t<I>>;
    constexpr int column = first_parameter<Chain>[I];
    if constexpr (count == 1) {
      y_(plan.row_of_gen[std::size_t{wiring::slot(I, 0)}], column) = as<S>(joints_.template at_port<I, 0>().q_ddot);
    } else if constexpr (count > 0) {
      constexpr int on = wiring::writer(types::template what<I, 0>, wiring::slot(I, 0));
      const auto& frame = joints_.template at_port<I, 0>();
      const motion x{
          skip{}, skip{}, skip{}, as<S>(frame.ang_velocity), as<S>(frame.acceleration), as<S>(frame.ang_acceleration)};
      add_body<count>(joints_of<Chain>::joint_of(on), as<S>(matrix(frame.rotation)),
                      as<S>(joints_.template way_to<on>()), x, column);
    }
  }
  /// Separate, so that it is instantiated once for all bodies.
  template <int Count, class Motion>
  void add_body(int joint, const mat3<vec3<S>>& rotation, const vec3<S>& way, const Motion& x, int column) {
    engine::forces_by_parameters<S>(
        x, [&](const auto& put) KTE_INLINE_LAMBDA { engine::frame_columns(joints_, joint, rotation, way, put); },
        [this, column](int k, const engine::per_parameter<S>& all) KTE_INLINE_LAMBDA {
          const int row = joints::row[static_cast<std::size_t>(k)];
          for (int i = 0; i < Count; ++i) y_(row, column + i) += engine::parameter_at(all, i, Count);
        });
  }
  /// Adds the row of a dependent coordinate to that of its leading coordinate: q_end' = ratio q_base'.
  template <std::size_t I>
  KTE_INLINE void pull_back() {
    if constexpr (has_output<core_t<I>> && core_t<I>::ports[0].what == kind::gen &&
                  types::template output_kind<I> == kind::gen) {
      constexpr int base = plan.row_of_gen[std::size_t{wiring::slot(I, 0)}];
      constexpr int end = plan.row_of_gen[std::size_t{types::template output_slot<I>}];
      const S ratio =
          as<S>(chain_.template core<I>().doMotion(unit_rate<kind::gen, 0>(joints_.template at_port<I, 0>())).q_dot);
      for (int i = 0; i < parameters_of<Chain>; ++i) y_(base, i) += ratio * y_(end, i);
    }
  }

  const Chain& chain_;
  const joints joints_;
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
