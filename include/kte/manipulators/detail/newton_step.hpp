#pragma once

#include <kte/manipulators/detail/raw_answers.hpp>

namespace kte::detail {

/// Six linear equations with their right-hand sides.
template <class S>
using six_equations = std::array<std::array<S, 7>, 6>;

/// Solves M x = b by elimination with complete pivoting; returns false if a pivot is below `least`.
template <class S>
bool solve_six(six_equations<S>& m, std::array<S, 6>& x, double least = 1e-12) {
  for (std::size_t c = 0; c < 6; ++c) {
    std::size_t best = c;
    for (std::size_t r = c + 1; r < 6; ++r)
      if (std::abs(double_of(m[r][c])) > std::abs(double_of(m[best][c]))) best = r;
    if (!(std::abs(double_of(m[best][c])) > least)) return false;
    std::swap(m[c], m[best]);
    for (std::size_t r = c + 1; r < 6; ++r) {
      const S ratio = m[r][c] / m[c][c];
      for (std::size_t k = c; k < 7; ++k) m[r][k] -= ratio * m[c][k];
    }
  }
  for (std::size_t r = 6; r-- > 0;) {
    x[r] = m[r][6];
    for (std::size_t k = r + 1; k < 6; ++k) x[r] -= m[r][k] * x[k];
    x[r] = x[r] / m[r][r];
  }
  return true;
}

/// The equations J d = e for six joints at t, from joint `first` on. e = (p_d - p, the axial vector of R_d R^T);
/// lengths in units of `reach`.          (1)
template <class S>
six_equations<S> towards_pose(const arm_geometry& arm, std::size_t first,
                              const pose<rotation_matrix<S>, vec3<S>>& wanted, const by_joint<S>& t, double reach) {
  const auto turn = turns_of(t);
  by_joint<vec3<S>> axis, at;
  pose<rotation_matrix<S>, vec3<S>> x{as<S>(mat3<vec3<>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), {S(0), S(0), S(0)}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.n); ++i) {
    axis[i] = x.rotation * as<S>(arm.axis[i]);
    at[i] = x.position + x.rotation * as<S>(arm.point[i]);
    x = compose(x, joint_pose<S>(arm, i, t[i], turn.at(i)));
  }
  const rotation_matrix<S> R = x.rotation * as<S>(arm.tool.rotation);
  const vec3<S> p = x.position + x.rotation * as<S>(arm.tool.position);
  const S unit = S(1 / reach), half = S(1) / S(2);
  const vec3<S> d = unit * vec3<S>(wanted.position - p);
  const auto E = wanted.rotation * transpose(R);
  const vec3<S> w{half * (E.z.y - E.y.z), half * (E.x.z - E.z.x), half * (E.y.x - E.x.y)};
  six_equations<S> m;
  for (std::size_t k = 0; k < 6; ++k) {
    const vec3<S> h = axis[first + k], v = unit * cross(h, vec3<S>(p - at[first + k]));
    m[0][k] = v.x, m[1][k] = v.y, m[2][k] = v.z, m[3][k] = h.x, m[4][k] = h.y, m[5][k] = h.z;
  }
  m[0][6] = d.x, m[1][6] = d.y, m[2][6] = d.z, m[3][6] = w.x, m[4][6] = w.y, m[5][6] = w.z;
  return m;
}

/// One Newton step of (1), if no angle changes by more than `most`, rad: for a solution that is accurate up to
/// rounding.
template <class S>
void newton_step(six_equations<S> m, std::size_t first, by_joint<S>& t, double most) {
  std::array<S, 6> step;
  if (!solve_six(m, step)) return;
  double longest = 0;
  for (const auto& s : step) longest = (std::max)(longest, std::abs(double_of(s)));
  if (!(longest < most)) return;
  for (std::size_t k = 0; k < 6; ++k) t[first + k] += step[k];
}

/// A damped step for a nearly singular J, (J^T J + mu) d = J^T e with mu = |e|/1000 (Levenberg, Marquardt). At a double
/// root each step leaves a quarter of e; away from it the steps become Newton's.
template <class S>
void damped_step(const six_equations<S>& m, std::size_t first, by_joint<S>& t) {
  const double eps = double_of(std::numeric_limits<S>::epsilon());
  six_equations<S> squares{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < 7; ++k)
      for (std::size_t r = 0; r < 6; ++r) squares[i][k] += m[r][i] * m[r][k];
  double size = 0;
  for (const auto& row : m) size += double_of(row[6]) * double_of(row[6]);
  const double mu = (std::max)(1e-3 * std::sqrt(size), 8 * eps);
  for (std::size_t i = 0; i < 6; ++i) squares[i][i] += S(mu);
  std::array<S, 6> step;
  if (!solve_six(squares, step, eps)) return;
  for (std::size_t k = 0; k < 6; ++k) t[first + k] += step[k];
}

}  // namespace kte::detail
