#pragma once

#include <kte/dynamics/runtime/frames.hpp>

/// Accelerations of frames of runtime chains in the world. States represent gravity as an acceleration of bases.
namespace kte::detail {

/// Removes gravity g from the acceleration of a base, and restores the exact value when destroyed.
template <class Frame>
class base_without_gravity {
 public:
  base_without_gravity(Frame& base, const vec3<>& g) : base_(base), kept_(base.acceleration) {
    const auto a = transpose(matrix(spatial(base).rotation)) * g;
    base_.acceleration.x += a.x, base_.acceleration.y += a.y;
    if constexpr (requires { base_.acceleration.z; }) base_.acceleration.z += a.z;
  }
  ~base_without_gravity() { base_.acceleration = kept_; }
  base_without_gravity(const base_without_gravity&) = delete;
  base_without_gravity& operator=(const base_without_gravity&) = delete;

 private:
  Frame& base_;
  decltype(Frame::acceleration) kept_;
};

/// `move` of a frame, with bases i, i + 1, ... of kind K and all of later kinds without gravity. Recurses once per
/// base, so nothing is allocated.
template <kind K, class S>
void move_without_gravity(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x,
                          std::size_t i = 0) {
  const auto& writers = c.wiring().writers[static_cast<std::size_t>(K)];
  while (i < writers.size() && writers[i] >= 0) ++i;
  if (i < writers.size()) {
    auto& base = s.template get<K>(static_cast<int>(i));
    const base_without_gravity<std::remove_reference_t<decltype(base)>> aside(base, c.gravity());
    move_without_gravity<K>(c, s, x, i + 1);
  } else if constexpr (K == kind::frame_2D) {
    move_without_gravity<kind::frame_3D>(c, s, x);
  } else {
    move(c.wiring(), s, x);
  }
}

/// Calls f(position, rotation, velocities and accelerations) for a frame at the state's coordinates, without gravity.
/// For a frame that joints and links move, gravity is subtracted from its acceleration,
///
///   a + R^T g          (1)
///
/// For a frame that follows others, only part of gravity may be included; its motion is computed with bases without
/// gravity.
template <class S, class F>
auto with_motion_in_world(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x, const F& f) {
  static_assert(goes_through_passes<S>);
  const vec3<> all = c.gravity(), g = x.what == kind::frame_2D ? vec3<>{all.x, all.y, 0.0} : all;
  if (s.tree().body_tree.frame(x.what, x.index).slot >= 0) [[likely]] {
    move(c.wiring(), s, x);
    return with_motion(s, x, [&](const auto& m) {
      return f(motion{m.position, m.rotation, m.velocity, m.ang_velocity,
                      m.acceleration + transpose(matrix(m.rotation)) * g, m.ang_acceleration});
    });
  }
  move_without_gravity<kind::frame_2D>(c, s, x);
  const auto result = with_motion(s, x, f);
  move(c.wiring(), s, x);  // leaves the frames of the state as usual
  return result;
}

}  // namespace kte::detail
