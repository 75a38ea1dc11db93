#pragma once

#include <kte/sweep/varied_chain.hpp>

#include <Eigen/Core>

#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace kte_python {

/// The numbers that a case of a sweep changes.
struct case_numbers {
  Eigen::VectorXd q, v, third, u;
};

/// What the columns of a sweep change: `q/NAME` and `v/NAME` of a coordinate, `tau/NAME` or `a/NAME`, an input by its
/// name, or a parameter of the chain by its path. Numbers of coordinates with several are NAME/0, NAME/1 ...;
/// components of inputs with three NAME/x, NAME/y, NAME/z.
class sweep_columns {
 public:
  /// `third`: "tau", "a" or empty. Throws `unknown_name` for a column that is none of these.
  sweep_columns(const kte::runtime_chain& c, const std::vector<std::string>& columns, const std::string& third);

  /// Writes the values of a case into the numbers.
  void put(const std::vector<double>& values, case_numbers& x) const;
  /// The chain with the parameters of a case; nothing if no column is a parameter.
  std::optional<kte::runtime_chain> chain_with(const std::vector<double>& values) const;
  /// The paths of the parameters that vary.
  const std::vector<std::string>& paths() const { return paths_; }
  /// The values of a case for these paths.
  std::vector<double> parameters(const std::vector<double>& values) const;

 private:
  enum class what { q, v, third, input, parameter };
  struct target {
    what of;
    Eigen::Index index;
  };
  std::vector<target> targets_;
  std::vector<std::string> paths_;
  std::optional<kte::varied_chain> parameters_;
};

/// The names of the numbers of q, or of v, without prefix.
std::vector<std::string> names_of_numbers(const kte::runtime_chain& c, bool of_q);
/// The names of all numbers of the inputs u of a chain.
std::vector<std::string> names_of_inputs(const kte::runtime_chain& c);
/// The inputs of a chain: the numbers of a dict, others zero. Throws as `put_inputs`.
Eigen::VectorXd inputs_from(const kte::runtime_chain& c, pybind11::handle inputs);

}  // namespace kte_python
