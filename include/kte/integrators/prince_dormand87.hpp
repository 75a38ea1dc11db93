#pragma once

#include <kte/integrators/detail/prince_dormand87_extension.hpp>
#include <kte/integrators/embedded_runge_kutta.hpp>

namespace kte {

/// Prince and Dormand, High order embedded Runge-Kutta formulae, J. Comput. Appl. Math. 7 (1981), 67-75: RK8(7)13M. The
/// fourteenth stage is the slope at the end. The published fractions meet the conditions of their orders to 7e-18.
struct prince_dormand87_tableau {
  static constexpr std::size_t stages = 14;
  static constexpr int order = 8, embedded_order = 7, dense_order = 7, order_of_error = 8;
  using row = tableau_row<stages>;

  static constexpr row c{{{0, 1},
                          {1, 18},
                          {1, 12},
                          {1, 8},
                          {5, 16},
                          {3, 8},
                          {59, 400},
                          {93, 200},
                          {5490023248, 9719169821},
                          {13, 20},
                          {1201146811, 1299019798},
                          {1, 1},
                          {1, 1},
                          {1, 1}}};
  static constexpr std::array<row, stages> a{{
      {},
      {{{1, 18}}},
      {{{1, 48}, {1, 16}}},
      {{{1, 32}, {}, {3, 32}}},
      {{{5, 16}, {}, {-75, 64}, {75, 64}}},
      {{{3, 80}, {}, {}, {3, 16}, {3, 20}}},
      {{{29443841, 614563906}, {}, {}, {77736538, 692538347}, {-28693883, 1125000000}, {23124283, 1800000000}}},
      {{{16016141, 946692911},
        {},
        {},
        {61564180, 158732637},
        {22789713, 633445777},
        {545815736, 2771057229},
        {-180193667, 1043307555}}},
      {{{39632708, 573591083},
        {},
        {},
        {-433636366, 683701615},
        {-421739975, 2616292301},
        {100302831, 723423059},
        {790204164, 839813087},
        {800635310, 3783071287}}},
      {{{246121993, 1340847787},
        {},
        {},
        {-37695042795, 15268766246},
        {-309121744, 1061227803},
        {-12992083, 490766935},
        {6005943493, 2108947869},
        {393006217, 1396673457},
        {123872331, 1001029789}}},
      {{{-1028468189, 846180014},
        {},
        {},
        {8478235783, 508512852},
        {1311729495, 1432422823},
        {-10304129995, 1701304382},
        {-48777925059, 3047939560},
        {15336726248, 1032824649},
        {-45442868181, 3398467696},
        {3065993473, 597172653}}},
      {{{185892177, 718116043},
        {},
        {},
        {-3185094517, 667107341},
        {-477755414, 1098053517},
        {-703635378, 230739211},
        {5731566787, 1027545527},
        {5232866602, 850066563},
        {-4093664535, 808688257},
        {3962137247, 1805957418},
        {65686358, 487910083}}},
      {{{403863854, 491063109},
        {},
        {},
        {-5068492393, 434740067},
        {-411421997, 543043805},
        {652783627, 914296604},
        {11173962825, 925320556},
        {-13158990841, 6184727034},
        {3936647629, 1978049680},
        {-160528059, 685178525},
        {248638103, 1413531060}}},
      {{{14005451, 335480064},
        {},
        {},
        {},
        {},
        {-59238493, 1068277825},
        {181606767, 758867731},
        {561292985, 797845732},
        {-1041891430, 1371343529},
        {760417239, 1151165299},
        {118820643, 751138087},
        {-528747749, 2220607170},
        {1, 4}}},
  }};
  static constexpr row embedded{{{13451932, 455176623},
                                 {},
                                 {},
                                 {},
                                 {},
                                 {-808719846, 976000145},
                                 {1757004468, 5645159321},
                                 {656045339, 265891186},
                                 {-3867574721, 1518517206},
                                 {465885868, 322736535},
                                 {53011238, 667516719},
                                 {2, 45}}};

  using extension = prince_dormand87_extension;
};

/// The method of Prince and Dormand of order 8 with an embedded solution of order 7: thirteen evaluations a step. For
/// smooth right-hand sides and tight tolerances. The dense output of order 7 needs four more evaluations in each step
/// with samples, none in others.
///
///   kte::prince_dormand87 solver(f, 0.0, x0, {.absolute = 1e-12, .relative = 1e-12});
///   solver.integrate(10.0);
template <class F, class X>
class prince_dormand87 : public embedded_runge_kutta<prince_dormand87_tableau, F, X> {
 public:
  using embedded_runge_kutta<prince_dormand87_tableau, F, X>::embedded_runge_kutta;
};

template <class F, class V>
prince_dormand87(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
                 const tolerances<detail::time_scalar<typename V::Scalar>>& = {})
    -> prince_dormand87<detail::system_of<F, typename V::PlainObject>, typename V::PlainObject>;

}  // namespace kte

#ifdef KTE_EXTERN
namespace kte {
KTE_EXTERN template class embedded_runge_kutta<prince_dormand87_tableau, detail::erased_system<true>, Eigen::VectorXd>;
KTE_EXTERN template class integrator<
    embedded_runge_kutta<prince_dormand87_tableau, detail::erased_system<true>, Eigen::VectorXd>,
    detail::erased_system<true>, Eigen::VectorXd>;
}  // namespace kte
#endif
