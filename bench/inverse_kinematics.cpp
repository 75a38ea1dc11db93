/// Inverse kinematics of static arms: all answers by closed forms, one by iterations from a random start.
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/three_r_three_r.hpp>
#include <kte/manipulators/ur.hpp>

#include <algorithm>
#include <array>
#include <span>

#include "arm_timing.hpp"

namespace bench {
namespace {

template <class S>
using pose = kte::pose<kte::mat3<kte::vec3<S>>, kte::vec3<S>>;

/// Of as many questions as S has lanes.
template <class S, class Number>
pose<S> pose_of(const Number& number) {
  const auto row = [&](std::size_t i) {
    const auto entry = [&](std::size_t j) {
      return number([=](const arm_question& x) { return x.rotation[3 * i + j]; });
    };
    return kte::vec3<S>{entry(0), entry(1), entry(2)};
  };
  const auto place = [&](std::size_t i) { return number([=](const arm_question& x) { return x.position[i]; }); };
  return {{row(0), row(1), row(2)}, {place(0), place(1), place(2)}};
}
pose<double> pose_of(const arm_question& x) {
  return pose_of<double>([&](const auto& entry) { return entry(x); });
}
using eight = kte::pack<double, 8>;
pose<eight> poses_of(const arm_question* x) {
  return pose_of<eight>([&](const auto& entry) {
    std::array<double, 8> lanes;
    for (std::size_t l = 0; l < 8; ++l) lanes[l] = entry(x[l]);
    return eight::load(lanes.data());
  });
}
template <class Q>
double* put(const Q& q, double* to) {
  for (Eigen::Index i = 0; i < q.size(); ++i) *to++ = q[i];
  return to;
}

template <class Model>
struct arm_calls {
  static constexpr bool has_arm_angle = Model::arm.family() == kte::arm_family::srs;

  [[gnu::noinline]] static void closed(const arm_question* x, double* q, int* count) {
    *count = 0;
    const auto take = [&](const auto& all) {
      for (const auto& a : all)
        if (a.exact) q = put(a.q, q), ++*count;
    };
    if constexpr (has_arm_angle)
      take(kte::inverse_kinematics(Model::arm, pose_of(*x), kte::arm_angle(x->arm_angle)));
    else
      take(kte::inverse_kinematics(Model::arm, pose_of(*x)));
  }
  /// Eight poses at once (of seven axes at arm angle 0).
  [[gnu::noinline]] static void closed_pack8(const arm_question* x, double* q, int* count) {
    std::fill_n(count, 8, 0);
    for (const auto& a : kte::inverse_kinematics(Model::arm, poses_of(x))) {
      std::array<double, 8> exact;
      select(a.exact, eight(1), eight(0)).store(exact.data());
      for (std::size_t l = 0; l < 8; ++l) {
        if (exact[l] == 0) continue;
        double* to = q + l * room_for_answers + count[l]++ * Model::arm.dofs;
        for (Eigen::Index i = 0; i < a.q.size(); ++i) *to++ = a.q[i][l];
      }
    }
  }
  /// As it is called, from the closed form where that gives finitely many answers; numerically alone.
  template <bool Numeric>
  [[gnu::noinline]] static void numerical(const arm_question* x, double* q, int* count) {
    const std::span start(x->start, static_cast<std::size_t>(Model::arm.dofs));
    const auto r = kte::numerical_inverse_kinematics(Model::arm, kte::reach(kte::arm_names::tool, pose_of(*x)), start,
                                                     {.numeric = Numeric});
    put(r.q, q);
    *count = r.status == kte::numerical_ik_status::reached;
  }
  static void add() {
    add_arm("closed", Model::name, answer_kind::posture, closed);
    add_arm("closed_pack8", Model::name, has_arm_angle ? answer_kind::any : answer_kind::posture, closed_pack8, 8);
    add_arm("clik", Model::name, answer_kind::any, numerical<false>);
    add_arm("numeric", Model::name, answer_kind::any, numerical<true>);
  }
};

struct plain_arm {
  static constexpr auto name = "3R3R";
  static constexpr auto arm = kte::three_r_three_r();
};
struct ur5_arm {
  static constexpr auto name = "ur5";
  static constexpr auto arm = kte::ur();
};
struct iiwa14_arm {
  static constexpr auto name = "iiwa14";
  static constexpr auto arm = kte::iiwa14();
};
const registered inverse_kinematics_benchmarks{
    [] { arm_calls<plain_arm>::add(), arm_calls<ur5_arm>::add(), arm_calls<iiwa14_arm>::add(); }};

}  // namespace
}  // namespace bench
