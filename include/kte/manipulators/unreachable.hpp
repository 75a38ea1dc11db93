#pragma once

#include <kte/errors.hpp>

#include <Eigen/Core>

#include <vector>

namespace kte {

/// Why a pose is not reached.
enum class unreachable_reason {
  distance,       ///< it is too far, or too near
  limits,         ///< limits of coordinates hold the arm back
  local_minimum,  ///< the search found nothing better
};

/// No configuration within limits reaches a goal, or none was found; with the best there is.
struct unreachable : error {
  unreachable(const std::string& what, std::vector<double> q, double m, double rad, unreachable_reason why)
      : error(what), best(std::move(q)), linear(m), angular(rad), reason(why) {}

  std::vector<double> best;  ///< q
  double linear, angular;    ///< by which it misses, m and rad
  unreachable_reason reason;
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
                    std::move(best), linear, angular, why);
}
}  // namespace detail

}  // namespace kte
