#pragma once

#include "data/problems/mechanism.hpp"
#include "robots/iiwa14.hpp"

namespace kte::problems {

/// A KUKA LBR iiwa14 without brakes or motors falls for a second from a bent pose at rest, without limits of its
/// joints. The light wrist whirls: its rates reach 78 rad/s.
struct iiwa14_free_swing {
  static constexpr const char* name = "iiwa14, free swing";
  static constexpr long double t_end = 1;
  static constexpr const auto& model = robots::iiwa14;

  template <class S>
  static joint_vector<S, 7> start_q() {
    joint_vector<S, 7> q;
    q << S(0.25), S(0.75), S(-0.5), S(-1.0), S(0.5), S(1.0), S(-0.25);
    return q;
  }
  template <class S>
  static joint_vector<S, 7> start_v() {
    return joint_vector<S, 7>::Zero();
  }
  /// The angles, their rates, and the position of the tool, m.
  template <class S>
  static Eigen::Matrix<S, 17, 1> output(const joint_vector<S, 7>& q, const joint_vector<S, 7>& v) {
    Eigen::Matrix<S, 17, 1> r;
    r << q, v, to_eigen<S>(forward_kinematics(model, q, robots::iiwa14_names::tool).position);
    return r;
  }

  /// Integrated twice at 50 digits, by extrapolation of different orders; digits on which both agree. The parameters of
  /// the robot are its doubles, exactly.
  static constexpr known<17> references[]{
      {1.0L,
       {0.825468968308304801107511927L, 4.62907996368509603850512023L, 3.75254469819680553998583387L,
        1.52818310683548353941134188L, -16.972748846391510360421875L, 1.16744288087095833485005689L,
        5.44136801968333890202733088L, 3.42847965346001966136469777L, 1.97776221576725212176327218L,
        7.28321447524878673511849638L, 6.15369853584367605877140077L, -30.5791864712934434766882501L,
        17.0538289315093451818036091L, 17.332725410216752870749407L, -0.421040559558330295131950849L,
        -0.208599469686501175931342096L, 0.757285022224921521974971214L}}};
};

}  // namespace kte::problems
