#pragma once

#include <kte/sweep/sweep_cases.hpp>

#include <atomic>
#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace kte_python {

/// The names of columns of a sweep.
using column_names = std::vector<std::string>;
/// Set when a sweep is to end early.
using stop_flag = std::shared_ptr<std::atomic<bool>>;
/// Thrown in a sweep that ends early.
struct stopped {};

/// What a sweep runs without the GIL: one object for each shard.
class native_run {
 public:
  virtual ~native_run() = default;
  virtual std::unique_ptr<native_run> clone() const = 0;
  /// The names of the kept numbers.
  virtual const column_names& kept() const = 0;
  /// Computes the case with these values of its columns.
  virtual void operator()(const std::vector<double>& values, std::vector<double>& kept) = 0;
  /// The kept numbers of the cases from `begin` to `end`, exclusive, that can be computed together, in packs. Those of
  /// the others are empty. The result of a case does not depend on the others.
  virtual std::vector<std::vector<double>> in_packs(const kte::sweep_cases& /*cases*/, std::uint64_t begin,
                                                    std::uint64_t end) {
    return std::vector<std::vector<double>>(static_cast<std::size_t>(end - begin));
  }
};

/// Makes the run of a kte.SimulationRun or kte.OperationRun, for columns of these names.
std::unique_ptr<native_run> make_simulation_run(pybind11::handle run, const column_names& columns,
                                                const column_names& keep, stop_flag stop);
std::unique_ptr<native_run> make_operation_run(pybind11::handle run, const column_names& columns,
                                               const column_names& keep);

}  // namespace kte_python
