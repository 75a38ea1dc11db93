#include "dynamics/inverse_error.hpp"

// The inverse of the mass matrix of all that a tree may have.

namespace mass_matrix_inverse_trees_test {

using namespace kte;
using namespace kte::test::trees;

TEST_CASE("the inverse of the mass matrix of trees") {
  SECTION("in space") { check_inverse(joints_3D.gravity(fall), 1, base, cart); }
  SECTION("in the plane") { check_inverse(joints_2D, 2, floor_2D, wall); }
  SECTION("coordinates that are given, rotors, a mass without a joint") {
    check_inverse(rotors, 3, base, drive, motor, pull);
  }
}

}  // namespace mass_matrix_inverse_trees_test
