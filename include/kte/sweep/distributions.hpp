#pragma once

#include <kte/errors.hpp>
#include <kte/sweep/detail/counter_random.hpp>

#include <cmath>
#include <string>
#include <utility>

namespace kte {

/// A column of random numbers, or of the coordinates of Sobol points: its name and distribution. Made by `uniform`,
/// `log_uniform` and `normal`.
class distributed {
 public:
  /// The distributions.
  enum class kind { uniform, log_uniform, normal };

  distributed(std::string name, kind k, double a, double b) : name_(std::move(name)), kind_(k), a_(a), b_(b) {}
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The number below which a fraction p of the distribution lies, 0 < p < 1.
  [[nodiscard]] double operator()(double p) const {
    switch (kind_) {
      case kind::uniform:
        return a_ + p * (b_ - a_);
      case kind::log_uniform:
        return a_ * std::exp(p * std::log(b_ / a_));
      default:
        return a_ + b_ * detail::inverse_normal(p);
    }
  }

 private:
  std::string name_;
  kind kind_;
  double a_, b_;
};

namespace detail {
inline void check_distribution(bool ok, const std::string& name, const char* rule) {
  if (!ok) raise<bad_argument>("kte: the distribution of '" + name + "': " + rule);
}
}  // namespace detail

/// Evenly distributed from `least` to `most`.
[[nodiscard]] inline distributed uniform(std::string name, double least, double most) {
  detail::check_distribution(least <= most && std::isfinite(most - least), name, "bounds must be finite, in order");
  return {std::move(name), distributed::kind::uniform, least, most};
}
/// With an evenly distributed logarithm, from `least` to `most`, both positive.
[[nodiscard]] inline distributed log_uniform(std::string name, double least, double most) {
  detail::check_distribution(0 < least && least <= most && std::isfinite(most / least), name,
                             "bounds must be finite, positive, in order");
  return {std::move(name), distributed::kind::log_uniform, least, most};
}
/// Normally distributed, with a mean and a standard deviation.
[[nodiscard]] inline distributed normal(std::string name, double mean, double deviation) {
  detail::check_distribution(std::isfinite(mean) && std::isfinite(deviation) && deviation >= 0, name,
                             "mean and deviation must be finite, the deviation not negative");
  return {std::move(name), distributed::kind::normal, mean, deviation};
}

}  // namespace kte
