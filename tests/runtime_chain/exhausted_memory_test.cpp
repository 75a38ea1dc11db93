#include <kte/dynamics/mass_matrix.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "allocations.hpp"
#include "catch.hpp"

// Whichever allocation fails, and if all do that follow: chains and states are as before, or as they were to be.

namespace exhausted_memory_test {

using namespace kte;

inline constexpr struct tip_ final : frame_2D_key<"tip"> {
} tip;
inline constexpr struct hand_ final : frame_2D_key<"a hand of a long name"> {
} hand;
inline constexpr struct wrist_ final : coord_key<"a wrist of a long name"> {
} wrist;

/// Into which a chain has been put already.
runtime_chain pendulum() {
  auto joint = std::make_unique<runtime_chain>();
  *joint << revolute_joint_2D("q", "base", "joint");
  runtime_chain c;
  c.append(std::move(joint));
  c << rigid_link_2D("joint", "tip", along_x(0.5)) << inertia_2D("tip", point_mass(1.0));
  return c;
}
/// A second arm, with gravity, in a chain within a chain.
std::unique_ptr<runtime_chain> nested() {
  auto inner = std::make_unique<runtime_chain>(), outer = std::make_unique<runtime_chain>();
  *inner << revolute_joint_2D("a second coordinate of a long name", "tip", "a second joint of a long name")
         << inertia_2D("a second joint of a long name", point_mass(2.0));
  outer->append(std::move(inner)).gravity(along_y(-9.81));
  return outer;
}
bool same(const runtime_chain& a, const runtime_chain& b) {
  return record_of(a) == record_of(b) && a.wiring().names == b.wiring().names && a.nq() == b.nq() &&
         a.dofs() == b.dofs() && a.wiring().writers == b.wiring().writers &&
         a.wiring().elements.size() == b.wiring().elements.size() && a.wiring().nu == b.wiring().nu;
}

/// A change of a chain whose states are there or not.
struct chain_at_work {
  runtime_chain c = pendulum();
  runtime_state s = c.make_state();
};
template <class Change>
void check_change(const Change& change) {
  const auto before = pendulum();
  auto after = pendulum();
  change(after);
  for (const bool shared : {true, false})
    allocations::fail_each(
        [shared] {
          auto x = std::make_unique<chain_at_work>();
          if (!shared) x->s = runtime_chain().make_state();
          return x;
        },
        [&](auto& x) { change(x->c); },
        [&](auto& x, bool threw) {
          REQUIRE(same(x->c, threw ? before : after));
          if (threw) {
            if (shared) REQUIRE_NOTHROW(x->c.doMotion(x->s));  // still its state
            auto s = x->c.make_state();
            REQUIRE(mass_matrix(x->c, s)(0, 0) == 0.25);
            REQUIRE_NOTHROW(change(x->c));
          }
          REQUIRE(same(x->c, after));
          auto s = x->c.make_state(), t = after.make_state();
          REQUIRE(mass_matrix(x->c, s) == mass_matrix(after, t));
        });
}

TEST_CASE("a chain that cannot be changed for want of memory is as before") {
  SECTION("elements") {
    check_change([](runtime_chain& c) { c << rigid_link_2D("tip", "a tool of a long name", along_x(0.1)); });
    check_change([](runtime_chain& c) {
      c << revolute_joint_2D("a second coordinate of a long name", "tip", "a frame of a long name");
    });
  }
  SECTION("chains") {
    check_change([](runtime_chain& c) { c << *nested(); });
    check_change([](runtime_chain& c) { c.append(nested()); });
    check_change([](runtime_chain& c) {
      c << chain(revolute_joint_2D(wrist, tip, hand), inertia_2D(hand, point_mass(0.5))).gravity(along_x(1));
    });
  }
  SECTION("gravity") {
    check_change([](runtime_chain& c) { c.gravity(along_y(-1.5)); });
  }
  SECTION("copies and what takes all of another") {
    check_change([](runtime_chain& c) { c = runtime_chain(c); });
    check_change([](runtime_chain& c) {
      auto all = std::make_unique<runtime_chain>(c);
      runtime_chain other;
      other.append(std::move(all));
      c = std::move(other);
    });
  }
}

TEST_CASE("a state that cannot be made, copied or assigned for want of memory leaves all unchanged") {
  const auto small = pendulum();
  auto large = pendulum();
  large.append(nested());
  const auto works = [](const runtime_chain& c, runtime_state& s, double q) {
    REQUIRE(s.coordinate("q").q == q);
    REQUIRE_NOTHROW(c.doMotion(s));
    auto fresh = c.make_state();
    fresh.coordinate("q").q = q;
    REQUIRE(mass_matrix(c, s) == mass_matrix(c, fresh));
  };
  const auto at = [](const runtime_chain& c, double q) {
    auto s = std::make_unique<runtime_state>(c.make_state());
    s->coordinate("q").q = q;
    return s;
  };
  auto from = *at(large, 0.7);
  (void)mass_matrix(large, from);  // has made memory
  SECTION("made") {
    allocations::fail_each([] { return 0; }, [&](int) { (void)large.make_state(); },
                           [&](int, bool) { REQUIRE(record_of(large).elements.size() == 5); });
  }
  SECTION("copied") {
    allocations::fail_each([] { return 0; }, [&](int) { (void)runtime_state(from); },
                           [&](int, bool) { works(large, from, 0.7); });
  }
  SECTION("assigned") {
    allocations::fail_each([&] { return at(small, 0.2); }, [&](auto& s) { *s = from; },
                           [&](auto& s, bool threw) {
                             threw ? works(small, *s, 0.2) : works(large, *s, 0.7);
                             works(large, from, 0.7);
                           });
    auto same = at(large, 0.1);
    CHECK(allocations::during([&] { *same = from; }) == 0);
    works(large, *same, 0.7);
  }
  SECTION("moved") {
    auto to = at(small, 0.2);
    CHECK(allocations::during([&] { *to = std::move(from); }) == 0);
    works(large, *to, 0.7);
    from = std::move(*to);
    runtime_state there(std::move(from));
    works(large, there, 0.7);
    CHECK((from.dofs() == 0 && to->dofs() == 0));
    auto none = from;  // of a chain without elements, and goes on as such
    CHECK_NOTHROW(runtime_chain().doMotion(none));
    from = there;
    works(large, from, 0.7);
  }
}

}  // namespace exhausted_memory_test
