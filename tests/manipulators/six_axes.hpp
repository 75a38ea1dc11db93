#pragma once

#include "arms.hpp"

/// Arms of six axes with closed forms, and what is asked of their answers where they are singular.
namespace arms {

struct named_arm {
  const char* name;
  kte::manipulator<kte::runtime_chain> arm;
  kte::arm_family family;
  int least;  ///< answers that are exact, at random
};
inline const std::vector<named_arm>& six_axes() {
  static const std::vector<named_arm> all{
      {"3R3R", kte::manipulator(plain_3R3R(), "tool"), kte::arm_family::spherical_wrist, 8},
      {"IRB 2400", kte::manipulator(irb2400(), "tool"), kte::arm_family::spherical_wrist, 4},
      {"UR5", kte::manipulator(ur5(), "tool"), kte::arm_family::three_parallel, 4},
      {"bent", kte::manipulator(bent(), "tool"), kte::arm_family::spherical_wrist, 3},
      {"UR5 with offset", kte::manipulator(ur5_with_offset(), "tool"), kte::arm_family::three_parallel, 3}};
  return all;
}
/// Of these those without equations of degree four.
inline std::vector<named_arm> right_wrists() { return {six_axes().begin(), six_axes().begin() + 3}; }
/// Every answer to the pose of q is good, and there is one.
inline outcome check_hard(const named_arm& a, const numbers& q) {
  const auto r = check_answers(a.arm, q);
  CHECK(r.exact > 0);
  CHECK(r.finite);
  CHECK(r.position <= 1e-14);
  CHECK(r.rotation <= 1e-14);
  return r;
}

}  // namespace arms
