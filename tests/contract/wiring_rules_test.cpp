#include <kte/contract/wiring_rules.hpp>
#include <kte/runtime_chain/topology.hpp>
#include <kte/static_chain/wiring.hpp>

#include <random>

#include "catch.hpp"

// Static and runtime chains connect elements by the same rules.

namespace wiring_rules_test {

using namespace kte;
using namespace kte::detail;

constexpr std::size_t elements = 3, ports = 6;

/// Three elements of two ports, each on one of a few names.
struct drawn_chain {
  std::array<port, ports> all{};
  std::array<std::size_t, ports> name{};

  explicit drawn_chain(std::mt19937& engine) {
    const auto draw = [&engine](auto... one_of) {
      const std::array all_of{one_of...};
      return all_of[engine() % all_of.size()];
    };
    for (std::size_t p = 0; p < ports; ++p) {
      port& x = all[p];
      x.what = draw(kind::gen, kind::frame_3D, kind::frame_3D, kind::internal);
      x.how = x.what == kind::internal ? draw(access::in, access::keep)
              : x.what == kind::gen    ? draw(access::in, access::angle, access::on, access::out, access::base)
                                       : draw(access::in, access::on, access::out, access::base);
      x.role = "port";
      name[p] = engine() % 3 + (x.what == kind::gen ? 0 : 2);  // some meet, of one kind or of two
    }
  }
  problem of_compiler() const {
    std::array<port_use, ports + 1> use{};
    for (std::size_t p = 0; p < ports; ++p) {  // names of frames live apart
      const std::uint64_t id = 2 * name[p] + (is_frame(all[p].what) ? 1 : 0);
      use[p] = {all[p].what, all[p].how, id, id};
    }
    return resolve<ports, elements>(use, {0, 2, 4, 6}).error;
  }
  /// What a runtime chain says, or nothing.
  std::string at_run_time() const {
    topology t;
    try {
      for (std::size_t e = 0; e < elements; ++e) {
        const std::array to{std::string(1, static_cast<char>('a' + name[2 * e])),
                            std::string(1, static_cast<char>('a' + name[2 * e + 1]))};
        t.connect(nullptr, "element", std::span(all).subspan(2 * e, 2), to);
      }
      t.check_complete();
    } catch (const bad_wiring& e) {
      return e.what();
    }
    return {};
  }
};

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST_CASE("the rules of wiring") {
  const name_before nothing{}, read{true, true, false}, written{true, true, true}, other{true, false, true};
  wiring_rules rules;
  CHECK(rules.broken_by(kind::gen, kte::access::in, nothing) == problem::none);
  CHECK(rules.broken_by(kind::gen, kte::access::in, other) == problem::same_text);
  CHECK(rules.broken_by(kind::internal, kte::access::in, nothing) == problem::unknown);
  CHECK(rules.broken_by(kind::internal, kte::access::keep, nothing) == problem::none);
  CHECK(rules.broken_by(kind::frame_3D, kte::access::base, nothing) == problem::none);
  CHECK(rules.broken_by(kind::frame_3D, kte::access::on, nothing) == problem::none);  // the base of the chain
  CHECK(rules.broken_by(kind::frame_2D, kte::access::in, nothing) == problem::unknown);
  CHECK(rules.broken_by(kind::frame_3D, kte::access::in, read) == problem::none);
  CHECK(rules.broken_by(kind::frame_3D, kte::access::out, nothing) == problem::none);
  CHECK(rules.broken_by(kind::frame_3D, kte::access::in, written) == problem::none);
  for (const auto how : {kte::access::out, kte::access::base, kte::access::keep}) {
    CHECK(rules.broken_by(kind::gen, how, written) == problem::written_twice);
    CHECK(rules.broken_by(kind::gen, how, read) == problem::read_before_written);
  }
  wiring_rules later(true);
  CHECK(later.broken_by(kind::frame_3D, kte::access::in, nothing) == problem::unknown);
}

TEST_CASE("static and runtime chains refuse the same") {
  std::mt19937 engine(1);
  std::array<int, 6> met{};
  for (int round = 0; round < 20000; ++round) {
    const drawn_chain c(engine);
    const problem x = c.of_compiler();
    const std::string text = c.at_run_time();
    ++met[static_cast<std::size_t>(x)];
    CAPTURE(round, static_cast<int>(x), text);
    CHECK((x == problem::none) == text.empty());
    if (x == problem::same_text) CHECK(has(text, ", not a"));
    if (x == problem::written_twice) CHECK(has(text, "written twice"));
    // A runtime chain does not know later elements yet.
    if (x == problem::read_before_written)
      CHECK((has(text, "before it is written") || has(text, "no element before it")));
    if (x == problem::unknown) CHECK(has(text, "no element before it"));
    if (x == problem::moves_nothing) CHECK(has(text, "nothing moves by"));
  }
  for (const int times : met) CHECK(times > 100);
}

}  // namespace wiring_rules_test
