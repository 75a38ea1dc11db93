// expect: error: .*kte: this algorithm does not support closures of loops
#include <kte/kte.hpp>
#include <kte/loops.hpp>

inline constexpr struct pin_ final : kte::loop_key<"pin"> {
} pin;
inline constexpr struct q_ final : kte::coord_key<"q"> {
} q;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {
} base;
inline constexpr struct end_ final : kte::frame_2D_key<"end"> {
} end;

int main() {
  constexpr auto c = kte::chain(kte::revolute_joint_2D(q, base, end), kte::inertia_2D(end, kte::point_mass(1.0)),
                                kte::coincident_points_2D(pin, base, end));
  const double zero[1]{};
  return static_cast<int>(kte::inverse_dynamics(c, zero, zero, zero)[0]);
}
