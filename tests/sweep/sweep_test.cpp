#include <kte/io/table_reader.hpp>
#include <kte/math/pack.hpp>
#include <kte/sweep.hpp>

#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "sweep/folder.hpp"

namespace sweep_test {

using kte::test::says;

const auto cases = kte::random_cases(1000, 1, {kte::uniform("x", 0, 1)}) * kte::one_of("y", {1, 2});
/// Fails in some cases, and gives no number in one.
const auto f = [](const auto& c) {
  if (c.index() % 400 == 7) throw kte::bad_argument("kte: not \"this\",\none");
  const double x = c["x"], y = c["y"];
  return std::array{x * y, c.index() == 50 ? std::nan("") : x - y};
};
const std::vector<std::string> kept{"product", "difference"};
constexpr std::size_t failing[]{7, 50, 407, 807, 1207, 1607};

TEST_CASE("a sweep in memory: every case has its row, in order") {
  const auto result = kte::sweep(cases, kept, f, {.shard_size = 64}).table();
  CHECK(result.rows.names == std::vector<std::string>{"case", "x", "y", "product", "difference", "failed"});
  REQUIRE(result.rows.rows() == 2000);
  for (std::size_t i = 0; i < 2000; ++i) {
    CHECK(result["case"][i] == static_cast<double>(i));
    CHECK(result["x"][i] == cases(i, 0));
    if (std::find(std::begin(failing), std::end(failing), i) == std::end(failing)) {
      CHECK(result["product"][i] == cases(i, 0) * cases(i, 1));
      CHECK(result["failed"][i] == 0);
    } else {
      CHECK(result["failed"][i] == 1);
      CHECK(std::isnan(result["difference"][i]));
    }
  }
  REQUIRE(result.failures.size() == std::size(failing));
  CHECK(result.failures[0] == kte::sweep_failure{7, "kte: not \"this\",\none"});
  CHECK(result.failures[1] == kte::sweep_failure{50, "'difference' is not a number"});
  CHECK(result["product"][50] == cases(50, 0) * cases(50, 1));  // numbers that are known remain
}

TEST_CASE("a sweep has the same bytes by any executor, shard by shard or at once") {
  const folder at;
  const auto one = kte::sweep(cases, kept, f, {.shard_size = 64});
  const auto three = kte::sweep(cases, kept, f, {.shard_size = 64, .executor = kte::batch::threads(3)});
  for (const char* extension : {".csv", ".npy", ".mcap"}) {
    const auto a = at / (std::string("a") + extension), b = at / (std::string("b") + extension);
    one.to(a);
    three.to(b);
    CHECK(bytes_of(a) == bytes_of(b));
  }
  CHECK(bytes_of(at / "a.csv.failures.csv") == bytes_of(at / "b.npy.failures.csv"));
  CHECK(bytes_of(at / "a.csv.failures.csv").starts_with("case,reason\n7,\"kte: not \"\"this\"\", one\"\n50,"));

  const auto c = at / "c.npy";
  auto missing = one.missing(c);
  CHECK(missing.size() == 32);
  std::reverse(missing.begin(), missing.end());
  for (const auto shard : missing) {
    if (shard == 3) CHECK_THROWS_MATCHES(one.merge(c), kte::bad_file, says("shard 0 of 32 is missing"));
    one.compute(c, shard);
  }
  CHECK(one.missing(c).empty());
  one.merge(c);
  CHECK(bytes_of(c) == bytes_of(at / "a.npy"));
  CHECK_FALSE(std::filesystem::exists(at / "c.npy.parts"));
  const auto table = kte::read_table(c);
  CHECK(table["difference"][3] == cases(3, 0) - cases(3, 1));
  CHECK_THROWS_MATCHES(one.compute(c, 32), kte::bad_argument, says("has 32 shards, not a shard 32"));
}

TEST_CASE("a damaged shard is computed again, one of another sweep is refused") {
  const folder at;
  const auto file = at / "a.csv";
  const kte::sweep whole(cases, kept, f, {.shard_size = 500});
  for (const auto shard : whole.missing(file)) whole.compute(file, shard);
  const auto shard = at / "a.csv.parts/2.shard";
  auto bytes = bytes_of(shard);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(shard, std::ios::binary) << bytes;
  CHECK(whole.missing(file) == std::vector<std::uint64_t>{2});
  std::filesystem::resize_file(at / "a.csv.parts/1.shard", 100);
  CHECK(whole.missing(file) == std::vector<std::uint64_t>{1, 2});
  for (const auto& other :
       {kte::sweep(cases, kept, f, {.shard_size = 250}), kte::sweep(cases, kept, f, {.shard_size = 500, .note = "2"}),
        kte::sweep(cases, {"product", "sum"}, f, {.shard_size = 500}),
        kte::sweep(kte::random_cases(1000, 2, {kte::uniform("x", 0, 1)}) * kte::one_of("y", {1, 2}), kept, f,
                   {.shard_size = 500})})
    CHECK_THROWS_MATCHES(other.to(file), kte::bad_argument, says("has shards of another sweep"));
  whole.to(file);
  CHECK(kte::read_table(file).rows() == 2000);
}

TEST_CASE("a sweep that depends on other things does not continue, and says what differs") {
  const folder at;
  const auto file = at / "a.csv";
  const std::string chain(100, 'x');
  using texts = std::vector<std::pair<std::string, std::string>>;
  const auto sweep_of = [](const texts& depends_on, const kte::sweep_cases& of = cases, const std::string& note = "") {
    return kte::sweep(of, kept, f, {.shard_size = 500, .note = note, .depends_on = depends_on});
  };
  const auto whole = sweep_of({{"chain", chain}, {"time", "10"}});
  whole.compute(file, whole.missing(file).front());
  CHECK(sweep_of({{"chain", chain}, {"time", "10"}}).missing(file).size() == 3);
  const auto refused = [&](const kte::sweep& other, const std::string& why) {
    CHECK_THROWS_MATCHES(
        other.to(file), kte::bad_argument,
        says("a.csv.parts' has shards of another sweep (" + why + "): remove this folder to start again"));
  };
  refused(sweep_of({{"chain", chain}, {"time", "12"}}), "time is '12', not '10'");
  refused(sweep_of({{"chain", chain + "y"}, {"time", "10"}}), "another value of chain");
  refused(sweep_of({{"chain", chain}}), "they have time");
  refused(sweep_of({{"chain", chain}, {"time", "10"}, {"step", "1"}}), "they have no step");
  refused(sweep_of({{"chain", chain}, {"time", "10"}}, cases, "2"), "note is '2', not ''");
  refused(sweep_of({{"chain", chain}, {"time", "10"}}, kte::list_of_cases({"x", "y"}, {{1, 2}})),
          "number of cases is '1', not '2000'; another value of values of cases");
  // one of many listed cases
  std::vector<std::vector<double>> listed(1000, {1, 2});
  const auto other_file = at / "b.csv";
  CHECK(sweep_of({}, kte::list_of_cases({"x", "y"}, listed)).missing(other_file).size() == 2);
  listed[500] = {1, 3};
  CHECK_THROWS_MATCHES(sweep_of({}, kte::list_of_cases({"x", "y"}, listed)).missing(other_file), kte::bad_argument,
                       says("(another value of values of cases)"));
  std::ofstream(at / "a.csv.parts/sweep") << "0123456789abcdef\n";
  refused(whole, "they are of another version of kte");
  CHECK_THROWS_MATCHES(sweep_of({{"a\tb", "1"}}), kte::bad_argument, says("has a tab or the end of a line"));
}

TEST_CASE("cases in lanes: those that fail are found, the others are not affected") {
  using P = kte::pack<double, 8>;
  const auto in_lanes = [](const auto& c) {
    const auto x = c["x"], y = c["y"];
    for (std::size_t lane = 0; lane < 8; ++lane)
      if (c.index(lane) % 400 == 7) throw kte::bad_argument("bad");
    return std::array{x * y, x - y};
  };
  const auto result = kte::sweep(cases, kept, kte::in_packs<P>(in_lanes), {.shard_size = 100}).table();
  const auto expected = kte::sweep(cases, kept, f).table();
  REQUIRE(result.failures.size() == 5);
  for (std::size_t i = 0; i < 2000; ++i)
    if (i != 50 && result["failed"][i] == 0) CHECK(result["difference"][i] == expected["difference"][i]);
  CHECK(result.failures[1] == kte::sweep_failure{407, "bad"});
}

TEST_CASE("statistics and progress") {
  std::vector<kte::sweep_progress> told;
  const auto cases_4 = kte::one_of("x", {1, 2, 3, 6});
  const auto summary =
      kte::sweep(cases_4, {"same"}, [](const auto& c) { return std::vector{c["x"]}; },
                 {.shard_size = 1, .progress = [&](const kte::sweep_progress& p) { told.push_back(p); }})
          .table()
          .summary;
  CHECK(summary.cases == 4);
  REQUIRE(summary.statistics.size() == 1);
  const auto& s = summary.statistics[0];
  CHECK((s.name == "same" && s.count == 4 && s.least == 1 && s.most == 6 && s.mean == 3));
  CHECK(s.deviation() == within(std::sqrt(14.0 / 3), 1e-15));
  REQUIRE(told.size() == 1);  // faster than half a second: at the end only
  CHECK((told[0].done == 4 && told[0].total == 4 && told[0].found == 0));
  CHECK(kte::sweep_progress{.total = 10, .found = 2, .done = 6, .failed = 0, .seconds = 2}.left() == 2);
}

TEST_CASE("what a sweep refuses") {
  const auto x = kte::one_of("x", {1, 2});
  CHECK_THROWS_MATCHES(kte::sweep(x, {"x"}, f), kte::bad_argument, says("two columns are named 'x'"));
  CHECK_THROWS_MATCHES(kte::sweep(x, kept, f, {.shard_size = 0}), kte::bad_argument, says("at least one case"));
  CHECK_THROWS_MATCHES(kte::sweep(x, kept, f).to("a.xyz"), kte::bad_argument, says("no extension of a table"));
  const auto result = kte::sweep(x, {"a", "b", "c"}, f).table();
  CHECK(result.failures[0].reason == "kte: the cases have no column 'y'");
  const auto wrong = kte::sweep(x, kept, [](const auto& c) { return std::array{c["x"]}; }).table();
  CHECK(wrong.failures[0].reason == "kte: the function of the sweep gave 1 numbers for 2 columns");
}

}  // namespace sweep_test
