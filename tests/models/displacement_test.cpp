#include <kte/models/detail/displacement.hpp>

#include <algorithm>
#include <array>

#include "catch.hpp"
#include "digits50.hpp"
#include "random.hpp"

namespace displacement_test {

using namespace kte;
using test::digits50;

// Of long integrations nothing is lost in rounding, as what a step loses is known and added to the next.
TEST_CASE("what rounding takes from a displacement is known to a millionth of itself") {
  random_numbers random(3);
  for (const auto what : {kind::gen, kind::rotation_3D, kind::pose_2D, kind::pose_3D})
    for (const double size : {1e-6, 1e-3, 0.1, 3.0})
      for (int sample = 0; sample < 20; ++sample) {
        detail::freedom f{};
        f.what = what;
        std::array<double, 7> q{}, to{};
        std::array<double, 6> d{}, rest{};
        for (auto& x : q) x = random();
        for (auto& x : d) x = size * random();
        const std::size_t turn = what == kind::pose_3D ? 3 : 0;
        if (what == kind::rotation_3D || what == kind::pose_3D)
          detail::put_quaternion(q, int(turn), unit_quaternion<double>{q[turn], q[turn + 1], q[turn + 2], q[turn + 3]});
        detail::displace_one<double>(f, q, d, to);
        const bool stretched = sample % 2 == 1 && (what == kind::rotation_3D || what == kind::pose_3D);
        if (stretched)  // a user's own quaternion, of any length, which is rounded when it is made of length 1
          for (std::size_t i = turn; i < turn + 4; ++i) q[i] *= 0x1p40;
        detail::rounding_of_one<double>(f, q, d, to, rest);

        std::array<digits50, 7> exact{}, rounded{};
        std::array<digits50, 6> lost{};
        detail::displace_one<digits50>(f, q, d, exact);
        for (std::size_t i = 0; i < 7; ++i) rounded[i] = to[i];
        detail::displacement_between<digits50>(f, rounded, exact, lost);
        INFO("kind " << int(what) << ", size " << size << ", sample " << sample);
        // The arguments: vectors of this size, each rounded a few times.
        for (std::size_t i = 0; i < 6; ++i) {
          INFO("number " << i);
          CHECK(rest[i] ==
                test::within(static_cast<double>(lost[i]), stretched ? 1e-15 * std::max(1.0, size) : 1e-15 * size));
        }
      }
}

TEST_CASE("the size of a pose is that of its position and 1 for its rotation") {
  const std::array<double, 7> q{3, 4, 0, 1, 0, 0, 0};
  detail::freedom f{};
  std::array<double, 6> m{};
  f.what = kind::pose_2D;
  detail::magnitudes_of<double>(f, q, m);
  CHECK(m == std::array<double, 6>{5, 5, 1});
  f.what = kind::pose_3D;
  detail::magnitudes_of<double>(f, q, m);
  CHECK(m == std::array<double, 6>{5, 5, 5, 1, 1, 1});
}

}  // namespace displacement_test
