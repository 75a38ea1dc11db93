#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/manipulators/detail/arm_coordinates.hpp>
#include <kte/manipulators/path_profiles.hpp>

namespace kte {

/// A configuration q with its rates v and accelerations a.
template <class S, int NQ, int N>
struct motion_point {
  joint_vector<S, NQ> q;
  joint_vector<S, N> v, a;
};

/// A synchronized motion of all coordinates of a manipulator: straight in joint space; rotations and poses move at
/// constant direction.
///
///   q(t) = integrate(q_0, s(t) d),   v = s' d,   a = s'' d,   d = difference(q_0, q_1)            (1)
///
/// Limits of |v_i|, |a_i| and of jerks are therefore limits of s' and its derivatives over |d_i|. All configurations
/// between two configurations within limits are within limits. The object refers to the manipulator, which must outlive
/// it.
template <class Arm, class Profile>
class joint_motion {
  static constexpr int n = detail::arm_dofs<Arm>, nq = detail::arm_numbers<Arm>;

 public:
  joint_motion(const Arm& arm, const joint_vector<double, nq>& from, const joint_vector<double, n>& d, const Profile& p)
      : arm_(arm), from_(from), d_(d), profile_(p) {}
  /// The duration, s.
  [[nodiscard]] double duration() const { return profile_.duration(); }
  /// The point of the motion at time t, s; at rest before its start and after its end.
  motion_point<double, nq, n> operator()(double t) const {
    const auto [s, s_dot, s_ddot] = profile_(t);
    return {integrate(arm_, from_, d_, s), s_dot * d_, s_ddot * d_};  // (1)
  }

 private:
  const Arm& arm_;
  joint_vector<double, nq> from_;
  joint_vector<double, n> d_;
  Profile profile_;
};

namespace detail {
template <class Arm, class Q>
auto checked_end(const Arm& arm, const Q& q, const char* which) {
  joint_vector<double, arm_numbers<Arm>> out = neutral_configuration(arm);
  check_configuration_of(arm, q, which);
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = static_cast<double>(q[static_cast<std::size_t>(i)]);
  for_each_freedom_of(arm, [&](const freedom& f) {
    const auto i = static_cast<std::size_t>(f.v);
    if (f.what == kind::gen && !(arm.limits().lower[i] <= out[f.q] && out[f.q] <= arm.limits().upper[i]))
      raise<bad_argument>(std::string("kte: ") + which + " is beyond the limits of " + text_of_rate(layout(arm), f.v));
  });
  return out;
}
template <class Arm, class Q0, class Q1, class Make>
auto motion_between(const Arm& arm, const Q0& from, const Q1& to, const Make& profile) {
  check_limits_of_poses(arm);
  const auto q0 = checked_end(arm, from, "from"), q1 = checked_end(arm, to, "to");
  const joint_vector<double, arm_dofs<Arm>> d = difference(arm, q0, q1);
  path_limits<double> limits;
  for (Eigen::Index k = 0; k < d.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double length = std::abs(d[k]);
    if (length == 0) continue;
    limits.rate = (std::min)(limits.rate, arm.limits().rate[i] / length);
    limits.acceleration = (std::min)(limits.acceleration, arm.limits().acceleration[i] / length);
    limits.jerk = (std::min)(limits.jerk, arm.limits().jerk[i] / length);
  }
  return joint_motion(arm, q0, d, profile(limits, d));
}
/// Throws the error for a motion by d: neither the first moving coordinate nor any other moving coordinate has a limit
/// of `what`.
template <class Arm, class D>
[[noreturn]] void refuse_unlimited(const Arm& arm, const D& d, const std::string& motion, const std::string& what) {
  Eigen::Index i = 0;
  while (i < d.size() && d[i] == 0) ++i;
  if (i == d.size()) raise<bad_argument>("kte: " + motion + ": from and to are the same, and nothing moves");
  raise<bad_argument>("kte: " + motion + ": " + text_of_rate(layout(arm), static_cast<int>(i)) + " has no limit of " +
                      what +
                      ", nor has another that moves: give the manipulator one, as by "
                      "limits.acceleration[" +
                      std::to_string(i) + "] = 2, which files of robots do not have");
}
}  // namespace detail

/// The fastest straight motion from rest to rest within limits of rates and accelerations. Its jerk is infinite at four
/// instants. Throws `bad_argument` if no moving coordinate has a limit of acceleration (naming one), if an end is
/// outside the limits of positions, and if the ends are equal.
template <class Arm, indexable Q0, indexable Q1>
[[nodiscard]] auto trapezoidal_motion(const Arm& arm, const Q0& from, const Q1& to) {
  return detail::motion_between(arm, from, to, [&arm](const auto& limits, const auto& d) {
    if (limits.acceleration == limits.none) detail::refuse_unlimited(arm, d, "trapezoidal_motion", "acceleration");
    return trapezoidal_profile<double>(limits);
  });
}
/// The fastest straight motion by a polynomial of degree five from rest to rest within limits of rates, accelerations
/// and jerks, with a duration of at least `at_least`, s. Throws `bad_argument` if an end is outside the limits of
/// positions, and if neither limits nor a duration are given.
template <class Arm, indexable Q0, indexable Q1>
[[nodiscard]] auto quintic_motion(const Arm& arm, const Q0& from, const Q1& to, double at_least = 0) {
  return detail::motion_between(arm, from, to, [&arm, at_least](const auto& limits, const auto& d) {
    const bool unlimited =
        limits.rate == limits.none && limits.acceleration == limits.none && limits.jerk == limits.none;
    if (unlimited && at_least == 0) detail::refuse_unlimited(arm, d, "quintic_motion", "rate, acceleration or jerk");
    return quintic_profile<double>(limits, at_least);
  });
}

}  // namespace kte
