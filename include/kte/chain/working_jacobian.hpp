#pragma once

#include <kte/chain/working_element.hpp>
#include <kte/frames/inverse.hpp>

namespace kte::detail {

/// One element on the way from a frame to its base, in the Jacobian of the frame ((1) of dynamics/jacobian.hpp).
template <class Core, class State>
struct working_jacobian : working_element<Core, State> {
  using element = working_element<Core, State>;
  using typename element::S;

  /// Adds the columns of a joint, and sees the frame from one element further in.
  void inward() const {
    if constexpr (element::stiff) {
      auto& frame = this->state.work.seen;
      if constexpr (element::joint) columns(frame, std::make_integer_sequence<int, joint_dofs<Core>>{});
      const auto x = this->pose();
      const auto seen = compose(pose{matrix(x.rotation), x.position}, frame);
      frame = {as<S>(seen.rotation), as<S>(seen.position)};
    }
  }

 private:
  template <class Frame, int... N>
  void columns(const Frame& frame, std::integer_sequence<int, N...>) const {
    const auto c = this->coordinate();
    const auto t = transpose(frame.rotation);
    const int done[]{(put(this->place.row + N, t, frame.position, axis_of<N>(this->core, c)), 0)...};
    (void)done;
  }
  template <class T, class P, class Axis>
  void put(int column, const T& t, const P& p, const Axis& s) const {
    const auto v = as<S>(t * plus_cross(s.velocity, s.ang_velocity, p)), w = as<S>(t * s.ang_velocity);
    auto j = this->state.work.jacobian.col(column);
    j[0] += v.x, j[1] += v.y, j[2] += v.z;
    j[3] += w.x, j[4] += w.y, j[5] += w.z;
  }
};

}  // namespace kte::detail
