#pragma once

#include <kte/integrators/integrator.hpp>

namespace kte::sundials::detail {

/// What SUNDIALS has counted since it was started.
struct counts {
  long rejected_by_error = 0, rejected_by_newton = 0, jacobians = 0, factorizations = 0;

  long rejected() const { return rejected_by_error + rejected_by_newton; }
};

/// Adds what SUNDIALS counts, which begins at zero at every start, to the statistics of all that was integrated.
class accountant {
 public:
  void restart() { last_ = {}; }
  /// Returns how many steps were rejected since the last call.
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
