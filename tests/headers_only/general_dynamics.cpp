#include <kte/elements/mimic.hpp>
#include <kte/kte.hpp>
#include <kte/shared_coordinates.hpp>

#include "catch.hpp"

// Forward dynamics of chains that are no trees of joints: who brings it (runtime_chain/general_dynamics.hpp). Programs
// that link kte::compiled always have it.

using namespace kte;

constexpr rigid_body body{1.5, vec3{0.1, -0.2, 0.25}, sym3{0.2, 0.01, -0.02, 0.25, 0.03, 0.3}};
using general = detail::general_dynamics<runtime_state>;

TEST_CASE("without its header, forward dynamics names the coordinate that moves two joints") {
  general::known = nullptr;
  runtime_chain c;
  c << revolute_joint_3D("q", "base", "a", axis::y) << inertia_3D("a", body)
    << revolute_joint_3D("q", "a", "b", axis::x) << inertia_3D("b", body);
  auto s = c.make_state();
  std::string said;
  try {
    (void)forward_dynamics(c, s);
  } catch (const bad_argument& e) {
    said = e.what();
  }
  CHECK(said ==
        "kte: 'q' moves several joints: forward dynamics of such a chain needs #include "
        "<kte/shared_coordinates.hpp>");
  general::bring();
  CHECK(forward_dynamics(c, s).size() == 1);
}

TEST_CASE("elements that make coordinates follow bring it, joints do not") {
  general::known = nullptr;
  runtime_chain c;
  c << revolute_joint_3D("q", "base", "a", axis::y) << inertia_3D("a", body);
  CHECK(general::known.load() == nullptr);
  c << mimic_gen("q", "p", 2.0, 0.1);
  CHECK(general::known.load() != nullptr);
}
