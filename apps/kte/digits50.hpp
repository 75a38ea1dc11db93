#pragma once

#include <memory>
#include <string>
#include <vector>

#include "eval/evaluated_robot.hpp"
#include "eval/options.hpp"

/// What takes numbers of 50 digits: compiled once, apart.
namespace kte_tool {

/// The table of `kte eval` by 50 digits.
void print_with_50_digits(const evaluate::evaluated_robot& r, const evaluate::options& o);

/// What a chain does by 50 digits, rounded to doubles: matrices by rows.
class exact_chain {
 public:
  using list = std::vector<double>;

  /// Throws for chains of more than joints, links and bodies. `frame` may be empty.
  exact_chain(const kte::runtime_chain& chain, const std::string& frame);
  ~exact_chain();
  list inverse_dynamics(const list& q, const list& v, const list& a);
  list forward_dynamics(const list& q, const list& v, const list& tau);
  list mass_matrix(const list& q);
  /// M^-1 by its Cholesky factors.
  list mass_matrix_inverse(const list& q);
  /// By q, then by v.
  list inverse_derivatives(const list& q, const list& v, const list& a);
  list forward_derivatives(const list& q, const list& v, const list& tau);
  list energy(const list& q, const list& v);
  /// Position, then rotation.
  list pose(const list& q);
  list jacobian(const list& q);

 private:
  struct numbers;
  std::unique_ptr<numbers> numbers_;
};

}  // namespace kte_tool
