#include <kte/manipulators/era.hpp>
#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/opw.hpp>
#include <kte/manipulators/panda.hpp>
#include <kte/manipulators/scara.hpp>
#include <kte/manipulators/ssrms.hpp>
#include <kte/manipulators/three_r.hpp>
#include <kte/manipulators/three_r_three_r.hpp>
#include <kte/manipulators/ur.hpp>

#include "arms.hpp"
#include "chain/registered.hpp"

// Ten thousand random postures of each model that has a closed form: all answers right to rounding, and the posture
// among them.

namespace random_poses_test {

using namespace kte;
using namespace arms;

manipulator<runtime_chain> runtime(const model_record& record) { return {models::registered(record), "tool"}; }
/// (Operator + causes a warning of g++ 12.)
std::string name_of(int joint) { return std::string("q").append(std::to_string(joint + 1)); }
struct model {
  const char* name;
  manipulator<runtime_chain> arm;
  double answers;  ///< that are exact, the mean
  double found;    ///< how near the posture must be to an answer: next to double zeros the root of rounding
};

TEST_CASE("ten thousand random postures of each model", "[long]") {
  const model all[]{{"3R in the plane", runtime(record_of(three_r_2D_chain(1, 0.8, 0.3))), 2, 1e-9},
                    {"3R", runtime(record_of(three_r_chain(1, 0.8, 0.3, 0.1, 0.2, 0.4))), 2, 1e-9},
                    {"SCARA", runtime(record_of(scara_chain())), 2, 1e-9},
                    {"3R3R", runtime(record_of(three_r_three_r_chain())), 8, 1e-9},
                    {"IRB 2400", runtime(record_of(opw_chain())), 7.4, 1e-9},
                    {"UR5", runtime(record_of(ur_chain())), 7.1, 1e-9},
                    {"iiwa14", runtime(record_of(iiwa14_chain())), 8, 1e-9},
                    {"Panda", runtime(record_of(panda_chain())), 6.7, 1e-7},
                    {"ERA", runtime(record_of(era_chain())), 7.4, 1e-9},
                    {"SSRMS", runtime(record_of(ssrms_chain())), 7.3, 1e-7}};
  for (const auto& m : all) {
    INFO(m.name);
    const auto family = m.arm.family();
    const int held = m.arm.structure().held, count = 10000;
    const std::string name = name_of(held);
    random_numbers random(1);
    double position = 0, rotation = 0, found = 0;
    int exact = 0;
    for (int k = 0; k < count; ++k) {
      const auto q = random_posture(random, m.arm.dofs());
      const auto r = family == arm_family::srs         ? check_answers(m.arm, q, arm_angle(arm_angle_of(m.arm, q)))
                     : family == arm_family::offset_7R ? check_answers(m.arm, q, locked(name, q[held]))
                                                       : check_answers(m.arm, q);
      position = test::worse(position, r.position), rotation = test::worse(rotation, r.rotation);
      found = test::worse(found, r.found), exact += r.exact;
      CHECK(r.finite);
    }
    CHECK(position <= 1e-14);
    CHECK(rotation <= 1e-14);
    CHECK(found <= m.found);
    CHECK(exact / double(count) >= m.answers - 0.06);
  }
}

TEST_CASE("seven axes at a thousand arm angles, or values of the joint that is held", "[long]") {
  for (const auto& record : {record_of(iiwa14_chain()), record_of(panda_chain()), record_of(ssrms_chain())}) {
    const auto arm = runtime(record);
    const auto name = name_of(arm.structure().held);
    random_numbers random(2);
    for (int k = 0; k < 5; ++k) {
      auto q = random_posture(random, 7);
      const auto x = arm.getDependentPoses(q)[0];
      for (int i = 0; i < 1000; ++i) {
        const double t = -M_PI + 2e-3 * M_PI * i;
        const auto all = arm.family() == arm_family::srs ? inverse_kinematics(arm, x, arm_angle(t))
                                                         : inverse_kinematics(arm, x, locked(name, t));
        if (arm.family() == arm_family::srs) CHECK(all.size() == 8);
        for (const auto& a : all) {
          if (arm.family() == arm_family::srs) CHECK(a.exact);
          if (!a.exact) continue;
          const auto g = between(arm.getDependentPoses(a.q)[0], x);
          CHECK(g.position <= 1e-14 * arm.structure().reach);
          CHECK(g.rotation <= 1e-14);
        }
      }
    }
  }
}

}  // namespace random_poses_test
