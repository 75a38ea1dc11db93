#include <kte/static_chain/kept_states.hpp>

#include <thread>
#include <vector>

#include "catch.hpp"

// What large static chains keep between calculations: made once, lent to one calculation at a time.

namespace kept_states_test {

struct counts {
  std::atomic<int> made{0}, copied{0}, gone{0};
};
struct maker {
  counts* all;
  int number;
};
/// Something that takes long to make.
struct state {
  counts* all;
  int number;
  bool in_use = false;
  explicit state(const maker& m) : all(m.all), number(m.number) { ++all->made; }
  state(const state& o) : all(o.all), number(o.number) { ++all->copied; }
  state& operator=(const state&) = delete;
  ~state() { ++all->gone; }
};
struct other_state : state {
  using state::state;
};

using keeper = kte::detail::kept_states<true>;

TEST_CASE("a state is made once, and lent again") {
  counts all;
  {
    const keeper k;
    const maker m{&all, 7};
    state* first = nullptr;
    for (int round = 0; round < 3; ++round) {
      auto lent = k.borrow<state>(m);
      state& s = lent;
      CHECK(s.number == 7);
      if (round == 0) first = &s;
      CHECK(&s == first);
    }
    CHECK(all.made == 1);
    CHECK(all.copied == 1);  // the original is never lent
    auto one = k.borrow<state>(m), two = k.borrow<state>(m);
    CHECK(&static_cast<state&>(one) != &static_cast<state&>(two));
    CHECK(all.copied == 2);
    auto other = k.borrow<other_state>(m);
    CHECK(all.made == 2);
    CHECK(static_cast<other_state&>(other).number == 7);
  }
  CHECK(all.gone == all.made + all.copied);
}

TEST_CASE("what is kept is not copied, and goes when other numbers are assigned") {
  counts all;
  {
    keeper k;
    const maker seven{&all, 7}, eight{&all, 8};
    (void)k.borrow<state>(seven);
    const keeper copy = k;
    CHECK(static_cast<state&>(copy.borrow<state>(eight)).number == 8);
    k = copy;
    CHECK(all.gone == 2);
    CHECK(static_cast<state&>(k.borrow<state>(eight)).number == 8);
  }
  CHECK(all.gone == all.made + all.copied);
}

TEST_CASE("a failure in a calculation gives its state back") {
  counts all;
  const keeper k;
  const maker m{&all, 7};
  const auto fails = [&] {
    auto lent = k.borrow<state>(m);
    throw 1;
  };
  CHECK_THROWS_AS(fails(), int);
  CHECK_THROWS_AS(fails(), int);
  CHECK(all.copied == 1);
}

TEST_CASE("several threads never have the same state") {
  counts all;
  {
    const keeper k;
    const maker m{&all, 7};
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&] {
        for (int i = 0; i < 2000; ++i) {
          auto lent = k.borrow<state>(m);
          state& s = lent;
          if (s.in_use || s.number != 7) ++wrong;
          s.in_use = true;
          std::this_thread::yield();
          s.in_use = false;
        }
      });
    for (auto& t : threads) t.join();
    CHECK(wrong == 0);
  }
  CHECK(all.gone == all.made + all.copied);
}

TEST_CASE("what constants kept, which are never destroyed, goes when the next stands in their place") {
  counts all;
  const auto use = [&all](int number) {
    constexpr keeper k;
    constexpr keeper copy = k;
    (void)copy;
    return static_cast<state&>(k.borrow<state>(maker{&all, number})).number;
  };
  for (int i = 0; i < 100; ++i) CHECK(use(i) == i);
  CHECK(all.made + all.copied - all.gone <= 2 * 2);  // of one place, or two if the compiler takes two
}

}  // namespace kept_states_test
