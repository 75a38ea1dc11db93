#pragma once

#include <kte/errors.hpp>

#include <Eigen/Core>

#include <vector>

namespace kte {

/// Why a pose cannot be reached.
enum class unreachable_reason {
  distance,       ///< no posture reaches it
  limits,         ///< postures that reach it violate joint limits
  local_minimum,  ///< the search found no posture
};
/// A pose cannot be reached: the `reason`, and the best posture q.
struct unreachable : error {
  unreachable(const std::string& what, unreachable_reason why, std::vector<double> best, double m, double rad)
      : error(what), reason(why), q(std::move(best)), position(m), rotation(rad) {}

  unreachable_reason reason;
  std::vector<double> q;
  double position, rotation;  ///< errors of q, m and rad
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
