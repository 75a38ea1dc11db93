#ifndef KTE_REGRESSOR_HPP
#define KTE_REGRESSOR_HPP

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/regressor.hpp>

/// Inverse dynamics as a linear function of the inertial parameters of the bodies, for their identification.
namespace kte {

/// The inertial parameters pi of a chain, one body after the other in the order of its elements. An `inertia_3D` has
/// ten parameters (quantities and order of Pinocchio's `toDynamicParameters`),
///
///   m,  m c_x, m c_y, m c_z,  I_xx, I_xy, I_yy, I_xz, I_yz, I_zz          (1)
///
/// with the inertia about the origin of the frame to which the body is fixed, I = I_c + m (|c|^2 1 - c c^T), in axes of
/// this frame; kg, kg m, kg m^2. An `inertia_2D` has m, m c_x, m c_y, I_zz. An element with a mass on a coordinate
/// (`inertia_gen`) has this mass. The type of an element determines its parameters, not its values: a point mass also
/// has ten. Bodies that are fixed to each other have separate parameters.
template <class S = double, class Gravity, class... E>
[[nodiscard]] auto inertial_parameters(const static_chain<Gravity, E...>& c) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  Eigen::Matrix<S, parameters_of<chain_type>, 1> pi;
  unroll<chain_type::size>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    constexpr int first = first_parameter<chain_type>[I], count = parameter_count<core_of<chain_type, I>>;
    if constexpr (count == 1) {
      pi[first] = as<S>(c.template core<I>().template mass<S>());
    } else if constexpr (count > 0) {
      const auto b = c.template core<I>().template mass<S>();
      const vec3<S> h = as<S>(b.moment);
      const sym3<S> j = as<S>(b.inertia);
      const engine::per_parameter<S> all{as<S>(b.mass), h.x, h.y, h.z, j.xx, j.xy, j.yy, j.xz, j.yz, j.zz};
      for (int i = 0; i < count; ++i) pi[first + i] = engine::parameter_at(all, i, count);
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
/// with the forces Q of all elements without inertial parameters: springs, dampers, actuators. Y does not depend on pi,
/// only on joints, links and the placement of bodies; it includes the gravity of the chain. An entry is the force on a
/// coordinate due to a unit of a parameter: for a body in whose frame the unit rate of the coordinate makes the
/// velocity v and angular velocity u (its Jacobian),
///
///   v . (m a + al x h + w x (w x h)) + u . (I al + w x I w + h x a),   h = m c          (3)
///
/// A value for static chains; for runtime chains in the memory of the state, until the next call. Arguments and errors
/// as for `inverse_dynamics`. Throws `bad_argument` also
/// for a joint or link that is not described by its `relative` alone, and for distributed masses. Static chains use no
/// heap, unless the matrix is larger than EIGEN_STACK_ALLOCATION_LIMIT.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
[[nodiscard]] auto torque_regressor(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  check_configuration<chain_type>(q), check_velocities<chain_type>(v);
  check_rates<chain_type>(a, "a", "an acceleration");
  const configuration<S, typename chain_type::wiring, Q> at(q);
  const same_base few{motion{skip{}, no_rotation{}, skip{}, zero3{}, -c.gravity(), zero3{}}};
  const same_base whole{motion{zero3{}, no_rotation{}, zero3{}, zero3{}, -c.gravity(), zero3{}}};
  return regressor_of<S>(c, at, each<S, V>{v}, each<S, A>{a}, rest_base_of<chain_type>(few, whole));
}

template <class Gravity, class... E, class S>
[[nodiscard]] auto torque_regressor(const static_chain<Gravity, E...>& c,
                                    const chain_state<S, detail::wiring<E...>>& s) {
  using namespace detail;
  using state = chain_state<S, wiring<E...>>;
  const auto q = positions(s);
  const auto v = velocities(s), a = accelerations(s);
  using vector = std::remove_const_t<decltype(v)>;
  const configuration<S, wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return regressor_of<S>(c, at, each<S, vector>{v}, each<S, vector>{a}, base_of_state<state>{s});
}

}  // namespace kte

#endif

// ---- of runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_REGRESSOR_OF_RUNTIME_CHAINS)
#define KTE_REGRESSOR_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/bodies.hpp>
#include <kte/tree/regressor.hpp>

namespace kte {

namespace detail {
/// The number of inertial parameters of a chain.
inline int count_parameters(const runtime_chain& c) {
  int count = 0;
  for (const topology::connection& e : c.wiring().elements) count += e.parameters;
  return count;
}
/// Whether rows of the regressor are those of axes.
template <class S>
bool has_rows_of_axes(const basic_runtime_state<S>& s) {
  const auto& f = s.tree().body_tree;
  return f.in_order && static_cast<int>(f.axes()) == s.dofs() && s.tree().plan.coordinates == s.dofs();
}
/// Writes the columns of a body with `Count` parameters, from `column` on. Adds all entries to `sum`.
template <int Count, class S>
void put_columns_of_body(const basic_runtime_state<S>& s, const topology::connection& e, int column,
                         runtime_matrix<S>& y, tree::simd<S>& sum) {
  using numbers = tree::simd<S>;
  constexpr int lanes = static_cast<int>(tree::simd_of<S>::count);
  const auto& f = s.tree().body_tree;
  S* const columns = &y(0, column);
  const Eigen::Index stride = y.rows();
  const int* const row = f.row.data();
  const bool by_axes = has_rows_of_axes(s);
  tree::forces_by_parameters(f, s.work, s.work.axis_velocities, f.frame(e.ports[0].what, e.index[0]),
                             [=, &sum](int k, int first, const engine::per_parameter<numbers>& x) KTE_INLINE_LAMBDA {
                               numbers all = engine::parameter_at(x, 0, Count);
                               for (int i = 1; i < Count; ++i) all += engine::parameter_at(x, i, Count);
                               sum += all;
                               if (by_axes && k >= 0) {
                                 for (int i = 0; i < Count; ++i)
                                   tree::store<S>(engine::parameter_at(x, i, Count), columns + i * stride + k);
                                 return;
                               }
                               for (int i = 0; i < Count; ++i) {
                                 S each[lanes];
                                 tree::store<S>(engine::parameter_at(x, i, Count), each);
                                 for (int lane = (std::max)(first - k, 0); lane < lanes; ++lane) {
                                   S& entry = columns[i * stride + row[k + lane]];
                                   entry = by_axes ? each[lane] : S(entry + each[lane]);
                                 }
                               }
                             });
}
/// As `torque_regressor`, at the positions, rates and accelerations of the state.
template <class S>
const runtime_matrix<S>& regressor_of(const runtime_chain& c, basic_runtime_state<S>& s) {
  const auto& t = s.tree();
  refuse_distributed_masses(c, s);
  place_bodies(runtime_elements{c}, s);
  take_rates(s), take_bases(s);
  tree::move_bodies<false>(t.body_tree, s.work);
  tree::put_axes_in_rows(t.body_tree, s.work, s.work.axis_velocities);
  const int columns = count_parameters(c);
  auto& y = s.work.regressor;
  // Where axes are rows, each call writes the same entries.
  if (!has_rows_of_axes(s) || y.rows() != s.dofs() || y.cols() != columns) y.setZero(t.plan.coordinates, columns);
  tree::simd<S> sums{};
  S sum(0);
  int column = 0;
  for (const topology::connection& e : c.wiring().elements) {
    if (e.parameters == 1) {
      const int coordinate = e.index[0];
      S& entry = y(t.plan.row_of_gen[static_cast<std::size_t>(coordinate)], column);
      entry = s.template get<kind::gen>(coordinate).q_ddot;
      sum = S(sum + entry);
    } else if (e.parameters == 4) {
      put_columns_of_body<4>(s, e, column, y, sums);
    } else if (e.parameters == 10) {
      put_columns_of_body<10>(s, e, column, y, sums);
    }
    column += e.parameters;
  }
  S each[tree::simd_of<S>::count];
  tree::store<S>(sums, each);
  for (const S& x : each) sum = S(sum + x);
  pull_back_followers(runtime_elements{c}, s,
                      [&y](int to, int from, const S& ratio) { y.row(to) += ratio * y.row(from); });
  if (y.rows() != s.dofs()) y.conservativeResize(s.dofs(), columns);
  if (!tree::all_finite_in_row(&sum, 1)) [[unlikely]]
    check_result(y.data(), static_cast<std::size_t>(y.size()), [&s] { diagnose("a regressor", s); });
  return y;
}
}  // namespace detail

[[nodiscard]] Eigen::VectorXd inertial_parameters(const runtime_chain& c);
#ifdef KTE_FUNCTION
KTE_FUNCTION Eigen::VectorXd inertial_parameters(const runtime_chain& c) {
  using namespace detail;
  Eigen::VectorXd pi(count_parameters(c));
  int first = 0;
  for (const topology::connection& e : c.wiring().elements) {
    if (e.parameters == 0) continue;
    const element_numbers<double> n = e.element->numbers();
    const auto& [m, h, j] = n.weight;
    const engine::per_parameter<double> all{m, h.x, h.y, h.z, j.xx, j.xy, j.yy, j.xz, j.yz, j.zz};
    for (int i = 0; i < e.parameters; ++i)
      pi[first++] = e.parameters == 1 ? n.mass : engine::parameter_at(all, i, e.parameters);
  }
  return pi;
}
#endif

template <class S>
const runtime_matrix<S>& torque_regressor(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  detail::check_state_velocities(s);
  return detail::regressor_of(c, s);
}
template <class S, indexable Q, indexable V, indexable A>
const runtime_matrix<S>& torque_regressor(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                          const A& a) {
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, a).call([&]() -> const auto& { return detail::regressor_of(c, s); });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_matrix<double>& detail::regressor_of(const runtime_chain&, runtime_state&);
KTE_EXTERN template const runtime_matrix<double>& torque_regressor(const runtime_chain&, runtime_state&);
KTE_EXTERN template const runtime_matrix<double>& torque_regressor(const runtime_chain&, runtime_state&,
                                                                   const Eigen::VectorXd&, const Eigen::VectorXd&,
                                                                   const Eigen::VectorXd&);
#endif

}  // namespace kte

#endif
