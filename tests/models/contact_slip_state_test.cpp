#include <kte/models/detail/contact_slip_state.hpp>

#include "catch.hpp"

namespace contact_slip_state_test {

using namespace kte::detail;

constexpr slip_state states[]{slip_state::as_found, slip_state::slips, slip_state::stops,
                              slip_state::restarts, slip_state::holds, slip_state::rests};
constexpr slip_finding findings[]{slip_finding::stops, slip_finding::exceeds, slip_finding::others_hold};

TEST_CASE("decisions of slip end, because states only go forward") {
  for (const auto s : states)
    for (const auto f : findings) CHECK(next_state(s, f) >= s);
}
TEST_CASE("what stops twice holds, and what then exceeds friction rests") {
  auto s = slip_state::as_found;
  const auto go = [&s](slip_finding f) { return s = next_state(s, f); };
  CHECK(go(slip_finding::exceeds) == slip_state::slips);
  CHECK(go(slip_finding::others_hold) == slip_state::slips);
  CHECK(go(slip_finding::stops) == slip_state::stops);
  CHECK(go(slip_finding::exceeds) == slip_state::restarts);
  CHECK(go(slip_finding::stops) == slip_state::holds);
  CHECK(go(slip_finding::exceeds) == slip_state::rests);
  for (const auto f : findings) CHECK(next_state(slip_state::rests, f) == slip_state::rests);
}
TEST_CASE("stopped contacts hold together, moving ones go on") {
  for (const auto s : states) {
    const bool holds_now = is_stopped(s) && s != slip_state::rests;
    CHECK(next_state(s, slip_finding::others_hold) == (holds_now ? slip_state::holds : s));
  }
}
TEST_CASE("a contact that is found to exceed friction slides") {
  for (const auto s : states) CHECK(is_sliding(next_state(s, slip_finding::exceeds)));
}

}  // namespace contact_slip_state_test
