/// Inverse kinematics of static arms: all answers by closed forms, one by iterations from a random start.
#include <kte/manipulators/clik.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/three_r_three_r.hpp>
#include <kte/manipulators/ur.hpp>

#include <span>

#include "arm_timing.hpp"

namespace bench {
namespace {

using pose = kte::pose<kte::mat3<kte::vec3<>>, kte::vec3<>>;
pose pose_of(const arm_question& x) {
  const auto& r = x.rotation;
  return {{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}}, {x.position[0], x.position[1], x.position[2]}};
}
template <class Q>
double* put(const Q& q, double* to) {
  for (Eigen::Index i = 0; i < q.size(); ++i) *to++ = q[i];
  return to;
}

template <class Model>
struct arm_calls {
  [[gnu::noinline]] static int closed(const arm_question& x, double* q) {
    int count = 0;
    const auto take = [&](const auto& all) {
      for (const auto& a : all)
        if (a.exact) q = put(a.q, q), ++count;
    };
    if constexpr (Model::arm.family() == kte::arm_family::srs)
      take(kte::inverse_kinematics(Model::arm, pose_of(x), kte::arm_angle(x.arm_angle)));
    else
      take(kte::inverse_kinematics(Model::arm, pose_of(x)));
    return count;
  }
  [[gnu::noinline]] static int numeric(const arm_question& x, double* q) {
    const std::span start(x.start, static_cast<std::size_t>(Model::arm.dofs));
    const auto r = kte::clik(Model::arm, kte::reach(kte::arm_names::tool, pose_of(x)), start, {.numeric = true});
    put(r.q, q);
    return r.status == kte::clik_status::reached;
  }
  static void add() {
    add_arm("closed", Model::name, wanted::posture, closed);
    add_arm("numeric", Model::name, wanted::any, numeric);
  }
};

struct plain {
  static constexpr auto name = "3R3R";
  static constexpr auto arm = kte::three_r_three_r();
};
struct ur5 {
  static constexpr auto name = "ur5";
  static constexpr auto arm = kte::ur();
};
struct iiwa14 {
  static constexpr auto name = "iiwa14";
  static constexpr auto arm = kte::iiwa14();
};
const registered here{[] { arm_calls<plain>::add(), arm_calls<ur5>::add(), arm_calls<iiwa14>::add(); }};

}  // namespace
}  // namespace bench
