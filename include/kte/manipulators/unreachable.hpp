#pragma once

#include <kte/errors.hpp>

#include <Eigen/Core>

#include <vector>

namespace kte {

/// What was asked for cannot be reached.
enum class unreachable_reason {
  distance,       ///< no posture gets there
  limits,         ///< those that do are beyond the limits of joints
  local_minimum,  ///< a search ended elsewhere
};
/// As an error, with the best that there is.
struct unreachable : error {
  unreachable(const std::string& what, unreachable_reason why, std::vector<double> best, double m, double rad)
      : error(what), reason(why), q(std::move(best)), position(m), rotation(rad) {}

  unreachable_reason reason;
  std::vector<double> q;
  double position, rotation;  ///< residual of q: m, rad
};

namespace detail {
template <class Q>
[[noreturn]] void raise_unreachable(const Q& q, double linear, double angular, unreachable_reason why) {
  std::vector<double> best;
  for (Eigen::Index i = 0; i < q.size(); ++i) best.push_back(static_cast<double>(q[i]));
  const char* const because = why == unreachable_reason::distance ? "it is out of reach"
                              : why == unreachable_reason::limits ? "limits hold the arm back"
                                                                  : "the search found nothing better";
  throw unreachable("kte: a goal is missed by " + number(linear) + " m and " + number(angular) + " rad: " + because,
                    why, std::move(best), linear, angular);
}
}  // namespace detail

}  // namespace kte
