#pragma once

#include <kte/integrators/integrator.hpp>

namespace kte::sundials::detail {

/// The counters of SUNDIALS since it was started.
struct counts {
  long rejected_by_error = 0, rejected_by_newton = 0, jacobians = 0, factorizations = 0;

  long rejected() const { return rejected_by_error + rejected_by_newton; }
};

/// Adds the counters of SUNDIALS, which start at zero at every start, to the statistics.
class accountant {
 public:
  void restart() { last_ = {}; }
  /// Returns the number of rejected steps since the last call.
  long add(const counts& now, step_statistics& all) {
    const long rejected = now.rejected() - last_.rejected();
    all.rejected += rejected;
    all.jacobians += now.jacobians - last_.jacobians;
    all.factorizations += now.factorizations - last_.factorizations;
    last_ = now;
    return rejected;
  }

 private:
  counts last_;
};

}  // namespace kte::sundials::detail
