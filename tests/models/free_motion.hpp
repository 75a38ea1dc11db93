#pragma once

#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

#include <cstddef>
#include <functional>
#include <type_traits>

#include "data/problems/dzhanibekov.hpp"

/// Motions without actuation of the chains of data/problems, by methods of a given step.
namespace kte::test::free_motion {

template <template <class, class> class Method, class Problem>
auto start(double h) {
  manipulator_dynamics_model model(Problem::model);
  const auto x0 = model.make_x(Problem::template start_q<double>(), Problem::template start_v<double>());
  return Method<decltype(model), std::remove_const_t<decltype(x0)>>(model, 0.0, x0, h);
}
/// Of outputs a, b, ... of a problem at reference number i.
template <class Problem, class X>
double error_of(const X& x, std::size_t i) {
  constexpr int nq = std::remove_cvref_t<decltype(Problem::model)>::nq;
  constexpr int n = std::remove_cvref_t<decltype(Problem::model)>::dofs;
  const joint_vector<double, nq> q = x.template head<nq>();
  const joint_vector<double, n> v = x.template tail<n>();
  return static_cast<double>(problems::largest_error(Problem::output(q, v), Problem::references[i].values));
}

/// World momenta, angular about the origin.
template <class Chain, class X>
Eigen::Matrix<double, 6, 1> momenta(const Chain& c, const X& x) {
  const joint_vector<double, Chain::nq> q = x.template head<Chain::nq>();
  const joint_vector<double, Chain::dofs> v = x.template tail<Chain::dofs>();
  const auto h = centroidal_momentum(c, q, v);
  const auto l = as<double>(h.angular + cross(centre_of_mass(c, q).position, h.linear));
  return (Eigen::Matrix<double, 6, 1>() << h.linear.x, h.linear.y, h.linear.z, l.x, l.y, l.z).finished();
}

}  // namespace kte::test::free_motion
