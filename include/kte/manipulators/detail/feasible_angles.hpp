#pragma once

#include <kte/detail/short_list.hpp>
#include <kte/manipulators/detail/in_limits.hpp>
#include <kte/manipulators/detail/srs_axes.hpp>
#include <kte/math/atan2.hpp>

#include <algorithm>

namespace kte {

/// Arm angles psi, lower <= psi <= upper, at which a solution of a branch has all joints within limits. `upper` exceeds
/// pi if the interval continues beyond -pi.
struct arm_angle_interval {
  unsigned branch = 0;
  double lower = 0, upper = 0;
};

namespace detail {

/// Limits of the joints of an arm, in their order.
struct limits_by_joint {
  std::array<double, arm_geometry::most> lower{}, upper{};
};

/// Adds the psi with x.R03 y = c, by (1) of subproblems.hpp, for R03 = w v^T + cos psi (e_x f^T + e_y g^T) + sin psi
/// (e_y f^T - e_x g^T).
template <class List>
void add_crossings(const elbow_side<double>& side, const vec3<>& x, const vec3<>& y, double c, List& all) {
  const double xw = dot(x, side.w), xe = dot(x, side.ex), xn = dot(x, side.ey);
  const double yv = dot(y, side.v), yf = dot(y, side.f), yg = dot(y, side.g);
  const auto t = linear_in_angle(xe * yf + xn * yg, xn * yf - xe * yg, c - xw * yv, 1e-15);
  if (t.free) return;
  all.push_back(t.plus.value());
  all.push_back(t.minus.value());
}

/// All psi at which a joint of shoulder or wrist may pass a limit L (Shimizu et al. 2008), or is singular:
///
///   q1 = L:  h2.R(h1, -L) R03 h3 = h2.h3        q5 = L:  likewise for R47 = R34^T R03^T R07
///   q2 = L:  h1.R03 h3 = h1.R(h2, L) h3         q6 = L
///   q3 = L:  h1.R03 R(h3, -L) h2 = h1.h2        q7 = L          (1)
template <class List>
void add_all_crossings(const arm_structure& s, const elbow_side<double>& side, const rotation_matrix<double>& R07,
                       const limits_by_joint& limits, List& all) {
  const auto joint = [](int i) { return static_cast<std::size_t>(i); };
  const vec3<> axis7 = R07 * s.h(6);
  const auto in_link3 = [&](const vec3<>& v) { return turned(s.h(3), side.q4, v); };
  for (const auto* list : {&limits.lower, &limits.upper}) {
    const auto limit = [&](int i, const auto& add) {
      const double L = (*list)[joint(i)];
      if (L > -1e300 && L < 1e300) add(angle_of(L));
    };
    using turn_to = solved_angle<double>;
    limit(0,
          [&](const turn_to& L) { add_crossings(side, turned(s.h(0), L, s.h(1)), s.h(2), dot(s.h(1), s.h(2)), all); });
    limit(1,
          [&](const turn_to& L) { add_crossings(side, s.h(0), s.h(2), dot(s.h(0), turned(s.h(1), L, s.h(2))), all); });
    limit(2,
          [&](const turn_to& L) { add_crossings(side, s.h(0), turned(s.h(2), -L, s.h(1)), dot(s.h(0), s.h(1)), all); });
    limit(4, [&](const turn_to& L) {
      add_crossings(side, axis7, in_link3(turned(s.h(4), L, s.h(5))), dot(s.h(5), s.h(6)), all);
    });
    limit(5, [&](const turn_to& L) {
      add_crossings(side, axis7, in_link3(s.h(4)), dot(s.h(4), turned(s.h(5), L, s.h(6))), all);
    });
    limit(6, [&](const turn_to& L) {
      add_crossings(side, vec3<>(R07 * turned(s.h(6), -L, s.h(5))), in_link3(s.h(4)), dot(s.h(4), s.h(5)), all);
    });
  }
  for (const double straight : {1.0, -1.0}) {
    const solved_angle<double> t{straight, 0};
    add_crossings(side, s.h(0), s.h(2), dot(s.h(0), turned(s.h(1), t, s.h(2))), all);
    add_crossings(side, axis7, in_link3(s.h(4)), dot(s.h(4), turned(s.h(5), t, s.h(6))), all);
  }
}

/// Eight branches, between at most 34 crossings.
using arm_angle_list = short_list<arm_angle_interval, 8 * 36>;

/// Between neighbouring crossings nothing changes, so the middle of each interval is tested.
inline arm_angle_list feasible_angles(const arm_structure& s, const rotation_matrix<double>& R07,
                                      const vec3<>& position, const limits_by_joint& limits) {
  constexpr double pi = std::numbers::pi;
  arm_angle_list out;
  const auto sides = elbow_sides(s, position);
  const auto still = turns_of<double>({});
  const auto ok = [&](const raw_answers<double>& all, std::size_t a) {
    by_joint<double> sine, cosine, t;
    for (std::size_t i = 0; i < 7; ++i) sine[i] = all.sine[i][a], cosine[i] = all.cosine[i][a];
    atan2_each(sine.data(), cosine.data(), t.data(), 7);
    for (std::size_t i = 0; i < 7; ++i) {
      double q = s.sign[i] * t[i];
      if (!bring_within(limits.lower[i], limits.upper[i], false, 0.0, q)) return false;
    }
    return true;
  };
  for (const unsigned elbow : {0u, 1u}) {
    if (sides[elbow].slack > 1e-9 * s.reach) continue;
    short_list<double, 36> at;
    at.push_back(-pi);
    add_all_crossings(s, sides[elbow], R07, limits, at);
    at.push_back(pi);
    std::sort(at.item.begin(), at.item.begin() + static_cast<std::ptrdiff_t>(at.size()));
    for (unsigned k = 0; k < 4; ++k) {  // branches with this elbow
      const unsigned branch = (k & 1u ? shoulder_bit : 0u) | (k & 2u ? wrist_bit : 0u) | (elbow == 0 ? 0u : elbow_bit);
      short_list<arm_angle_interval, 36> own;
      for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const double lower = at[i], upper = at[i + 1];
        if (!(upper > lower)) continue;
        const auto answers = shoulder_and_wrist(s, R07, position, angle_of((lower + upper) / 2), still);
        if (!ok(answers, branch)) continue;  // in the order of branches
        if (!own.empty() && own[own.size() - 1].upper == lower)
          own[own.size() - 1].upper = upper;
        else
          own.push_back({branch, lower, upper});
      }
      const bool around = own.size() > 1 && own[0].lower == -pi && own[own.size() - 1].upper == pi;
      if (around) own[own.size() - 1].upper = own[0].upper + 2 * pi;
      for (std::size_t i = around ? 1 : 0; i < own.size(); ++i) out.push_back(own[i]);
    }
  }
  return out;
}

/// The arm angle of a posture, given by joint.
template <class S>
S arm_angle_at(const arm_structure& s, const vec3<S>& position, const by_joint<S>& q) {
  const auto sides = elbow_sides(s, position);
  auto R03 = as<S>(mat3<vec3<>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  for (const int i : {2, 1, 0}) R03 = turned_matrix(s.h(i), angle_of(q[static_cast<std::size_t>(i)]), R03);
  const auto q4 = angle_of(q[3]);
  const auto closeness = [&](const elbow_side<S>& x) { return x.q4.cos * q4.cos + x.q4.sin * q4.sin; };
  return (closeness(sides[0]) >= closeness(sides[1]) ? sides[0] : sides[1]).psi_of(R03).value();
}

}  // namespace detail
}  // namespace kte
