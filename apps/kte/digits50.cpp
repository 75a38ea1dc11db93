#include "digits50.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "eval/rows.hpp"
#include "eval/runtime_model.hpp"

namespace kte_tool {

namespace {

using fifty = boost::multiprecision::cpp_bin_float_50;
using model = evaluate::runtime_model<fifty>;

model::vector exactly(const std::vector<double>& x) { return {x.begin(), x.end()}; }
template <class M>
void append(std::vector<double>& out, const M& m) {
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) out.push_back(static_cast<double>(m(i, j)));
}
template <class M>
std::vector<double> rounded(const M& m) {
  std::vector<double> out;
  append(out, m);
  return out;
}

/// The inverse of a symmetric positive matrix, M = L L^T, M^-1 = L^-T L^-1.
std::vector<double> inverse_of(const Eigen::Matrix<fifty, Eigen::Dynamic, Eigen::Dynamic>& m) {
  const auto n = static_cast<std::size_t>(m.rows());
  std::vector<fifty> factor(n * n), inverse(n * n);
  const auto l = [&](std::size_t i, std::size_t j) -> fifty& { return factor[i * n + j]; };
  const auto w = [&](std::size_t i, std::size_t j) -> fifty& { return inverse[i * n + j]; };  // L^-1
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      fifty x = m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      for (std::size_t k = 0; k < j; ++k) x -= l(i, k) * l(j, k);
      l(i, j) = i == j ? fifty(sqrt(x)) : fifty(x / l(j, j));
    }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i < n; ++i) {
      fifty x = i == j ? 1 : 0;
      for (std::size_t k = j; k < i; ++k) x -= l(i, k) * w(k, j);
      w(i, j) = x / l(i, i);
    }
  std::vector<double> out;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      fifty x = 0;
      for (std::size_t k = std::max(i, j); k < n; ++k) x += w(k, i) * w(k, j);
      out.push_back(static_cast<double>(x));
    }
  return out;
}

}  // namespace

void print_with_50_digits(const evaluate::evaluated_robot& r, const evaluate::options& o) {
  model m(r.chain, o.frames);
  print_rows(m, evaluate::state_table(o.states), r.coordinates, o);
}

struct exact_chain::numbers {
  numbers(const kte::runtime_chain& c, const std::vector<std::string>& frames) : chain(c), exact(chain, frames) {}
  kte::runtime_chain chain;
  model exact;
};

exact_chain::exact_chain(const kte::runtime_chain& chain, const std::string& frame) {
  std::vector<std::string> frames;
  if (!frame.empty()) frames.push_back(frame);
  numbers_ = std::make_unique<numbers>(chain, frames);
}
exact_chain::~exact_chain() = default;

exact_chain::list exact_chain::inverse_dynamics(const list& q, const list& v, const list& a) {
  return rounded(numbers_->exact.inverse_dynamics(exactly(q), exactly(v), exactly(a)));
}
exact_chain::list exact_chain::forward_dynamics(const list& q, const list& v, const list& tau) {
  return rounded(numbers_->exact.forward_dynamics(exactly(q), exactly(v), exactly(tau)));
}
exact_chain::list exact_chain::mass_matrix(const list& q) { return rounded(numbers_->exact.mass_matrix(exactly(q))); }
exact_chain::list exact_chain::mass_matrix_inverse(const list& q) {
  return inverse_of(numbers_->exact.mass_matrix(exactly(q)));
}
exact_chain::list exact_chain::inverse_derivatives(const list& q, const list& v, const list& a) {
  const auto& d = numbers_->exact.inverse_derivatives(exactly(q), exactly(v), exactly(a));
  auto out = rounded(d.by_q);
  append(out, d.by_v);
  return out;
}
exact_chain::list exact_chain::forward_derivatives(const list& q, const list& v, const list& tau) {
  const auto& d = numbers_->exact.forward_derivatives(exactly(q), exactly(v), exactly(tau));
  auto out = rounded(d.by_q);
  append(out, d.by_v);
  return out;
}
exact_chain::list exact_chain::energy(const list& q, const list& v) {
  const auto e = numbers_->exact.energy(exactly(q), exactly(v));
  return {static_cast<double>(e.kinetic), static_cast<double>(e.potential)};
}
exact_chain::list exact_chain::pose(const list& q) {
  list out;
  numbers_->exact.for_each_frame(exactly(q), [&](const std::string&, const auto& pose, const auto&) {
    const auto& [R, p] = pose;
    for (const auto& row : {p, R.x, R.y, R.z})
      for (const auto& x : {row.x, row.y, row.z}) out.push_back(static_cast<double>(x));
  });
  return out;
}
exact_chain::list exact_chain::jacobian(const list& q) {
  list out;
  numbers_->exact.for_each_frame(exactly(q), [&](const std::string&, const auto&, const auto& j) { append(out, j); });
  return out;
}

}  // namespace kte_tool
