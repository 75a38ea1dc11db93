#include "from_textbook.hpp"

#include <complex>
#include <utility>

#include "textbook.hpp"

namespace bench {
namespace {

using dual = std::complex<real>;  // x + ih: f(x + ih) = f(x) + ih f'(x) to all digits, with h small
using vector = textbook<real>::vector;

template <class M>
block by_columns(const M& m) {
  block b;
  for (Eigen::Index j = 0; j < m.cols(); ++j)
    for (Eigen::Index i = 0; i < m.rows(); ++i) b.push_back(m(i, j));
  return b;
}
/// Columns f(e_0), f(e_1), ... for unit vectors e.
template <class F>
block columns(Eigen::Index n, const F& f) {
  block b;
  for (Eigen::Index j = 0; j < n; ++j) {
    const vector y = f(j);
    b.insert(b.end(), y.begin(), y.end());
  }
  return b;
}

std::array<vector, 3> vectors(const std::array<std::vector<double>, 3>& numbers) {
  std::array<vector, 3> x;
  for (std::size_t part = 0; part < 3; ++part)
    x[part] = Eigen::Map<const Eigen::VectorXd>(numbers[part].data(), Eigen::Index(numbers[part].size())).cast<real>();
  return x;
}

/// Columns of the regressor: inverse dynamics where one body has one inertial parameter, m, m c, I about the origin of
/// its frame, and nothing else has any. A first moment requires a mass, whose force is subtracted.
block columns_of_bodies(serial_robot robot, const vector& q, const vector& v, const vector& a) {
  for (auto& l : robot.links) l.mass = 0, l.com.setZero(), l.inertia.setZero();
  const auto forces = [&] { return textbook<real>(robot).inverse_dynamics(q, v, a); };
  block b;
  const auto put = [&b](const vector& y) { b.insert(b.end(), y.begin(), y.end()); };
  for (auto& l : robot.links) {
    const auto nothing = l;
    l.mass = 1;
    const vector of_mass = forces();
    put(of_mass);
    for (int i = 0; i < 3; ++i) {
      l.com = Eigen::Vector3d::Unit(i);
      l.inertia = l.com * l.com.transpose() - Eigen::Matrix3d::Identity();
      put(forces() - of_mass);
    }
    for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}}) {
      l = nothing;
      l.inertia(i, j) = l.inertia(j, i) = 1;
      put(forces());
    }
    l = nothing;
  }
  return b;
}

}  // namespace

std::vector<block> from_textbook(operation o, const std::string& model,
                                 const std::array<std::vector<double>, 3>& numbers) {
  const auto robot = robot_of(model);
  const auto x = vectors(numbers);
  const textbook<real> t(robot);
  const auto &q = x[0], &v = x[1], &a = x[2];
  const auto n = t.dofs();
  const vector none = vector::Zero(n);
  const auto unit = [&](Eigen::Index j) { return vector::Unit(n, j); };
  const auto mass = [&] { return columns(n, [&](auto j) { return t.inverse_dynamics(q, none, unit(j), false); }); };
  const auto inverse = [&] { return columns(n, [&](auto j) { return t.forward_dynamics(q, none, unit(j), false); }); };
  const auto derivatives = [&](const auto& f, bool by_q) {
    const textbook<dual> stepping(robot);
    constexpr real h = 1e-100L;
    return columns(n, [&](auto j) {
      textbook<dual>::vector at[]{q.cast<dual>(), v.cast<dual>(), a.cast<dual>()};
      at[by_q ? 0 : 1][j] += dual(0, h);
      return vector(f(stepping, at[0], at[1], at[2]).imag() / h);
    });
  };
  /// The derivative of a function of q and v by time, with rates v and a.
  const auto by_time = [&](const auto& f) {
    constexpr real h = 1e-100L;
    const textbook<dual>::vector at = q.cast<dual>() + dual(0, h) * v.cast<dual>();
    const textbook<dual>::vector rate = v.cast<dual>() + dual(0, h) * a.cast<dual>();
    return by_columns((f(textbook<dual>(robot), at, rate).imag() / h).eval());
  };
  const auto id = [](const auto& book, const auto&... at) { return book.inverse_dynamics(at...); };
  const auto fd = [](const auto& book, const auto&... at) { return book.forward_dynamics(at...); };
  switch (o) {
    case operation::passes:
    case operation::inverse_dynamics:
      return {by_columns(id(t, q, v, a))};
    case operation::nonlinear_effects:
      return {by_columns(id(t, q, v, none))};
    case operation::forward_dynamics:
      return {by_columns(fd(t, q, v, a))};
    case operation::mass_matrix:
      return {mass()};
    case operation::mass_matrix_inverse:
      return {inverse()};
    case operation::id_derivatives:
      return {by_columns(id(t, q, v, a)), derivatives(id, true), derivatives(id, false), mass()};
    case operation::fd_derivatives:
      return {by_columns(fd(t, q, v, a)), derivatives(fd, true), derivatives(fd, false), inverse()};
    case operation::regressor:
      return {columns_of_bodies(robot, q, v, a)};
    case operation::jacobian:
      return {by_columns(t.forward_kinematics(q).jacobian)};
    case operation::jacobian_rate:
      return {
          by_time([](const auto& book, const auto& at, const auto&) { return book.forward_kinematics(at).jacobian; })};
    case operation::kinetic_energy:
      return {{t.sum_of_bodies(q, v).kinetic}};
    case operation::potential_energy:
      return {{t.sum_of_bodies(q, v).potential}};
    case operation::gravity_forces:
      return {by_columns(id(t, q, none, none))};
    case operation::coriolis_matrix:
      return {by_columns(vector(t.inverse_dynamics(q, v, none, false)))};
    case operation::momentum_matrix:
      return {columns(n, [&](auto j) { return t.sum_of_bodies(q, unit(j)).momentum; })};
    case operation::momentum_rate:
      return {by_time(
          [](const auto& book, const auto& at, const auto& rate) { return book.sum_of_bodies(at, rate).momentum; })};
    case operation::com_jacobian:
      return {columns(n, [&](auto j) {
        const auto whole = t.sum_of_bodies(q, unit(j));
        return vector(whole.momentum.template head<3>() / whole.mass);
      })};
    case operation::frames:
    case operation::forward_kinematics:
      const auto tool = t.forward_kinematics(q);
      return {by_columns(tool.rotation.transpose()), by_columns(tool.position)};  // rotations are by rows
  }
  return {};
}

}  // namespace bench
