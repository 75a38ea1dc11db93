// expect: error: .*kte: closures of loops are for runtime chains
#include <kte/elements/closures.hpp>
#include <kte/kte.hpp>

inline constexpr struct pin_ final : kte::loop_key<"pin"> {
} pin;
inline constexpr struct a_ final : kte::frame_2D_key<"a"> {
} a;
inline constexpr struct b_ final : kte::frame_2D_key<"b"> {
} b;

auto closure = kte::coincident_points_2D(pin, a, b);
