#include <kte/io/progress.hpp>
#include <kte/io/progress_bar.hpp>

#include <memory>
#include <string>
#include <vector>

#include "catch.hpp"

namespace progress_test {

using namespace kte;
using kte::test::contains_text;

/// A clock that stands until it is set.
struct hand_clock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<hand_clock>;
  static inline time_point time;

  static time_point now() { return time; }
  static void pass(double seconds) {
    time += std::chrono::duration_cast<duration>(std::chrono::duration<double>(seconds));
  }
};
struct call {
  double fraction, elapsed, left;
};
struct record {
  std::vector<call>* calls;
  void operator()(double fraction, double elapsed, double left) const { calls->push_back({fraction, elapsed, left}); }
};
using hand_progress = progress<record, hand_clock>;

TEST_CASE("progress is told once an interval and at the end") {
  std::vector<call> calls;
  hand_progress report(2.0, 12.0, record{&calls}, std::chrono::milliseconds(500));
  const auto step = [&](double seconds, double t) {
    hand_clock::pass(seconds);
    report(t, "whatever else observers get");
    return calls.size();
  };
  CHECK(step(0, 2) == 0);
  CHECK(step(0.25, 2.5) == 0);
  CHECK(step(0.25, 3) == 1);
  CHECK(calls.back().fraction == 0.1);
  CHECK(calls.back().elapsed == 0.5);
  CHECK(calls.back().left == within_relative(4.5, 5e-16));  // nine times as long as the first tenth; four roundings
  CHECK(step(0.375, 4) == 1);
  CHECK(step(0.375, 4.5) == 2);
  CHECK(calls.back().elapsed == 1.25);
  CHECK(calls.back().left == 3.75);
  CHECK(step(0.125, 12) == 3);  // the end, whatever the interval
  CHECK(calls.back().fraction == 1);
  CHECK(calls.back().elapsed == 1.375);
  CHECK(calls.back().left == 0);
  CHECK(step(100, 12) == 3);  // nothing after it
}

TEST_CASE("progress stays within 0 and 1, and knows no rest at 0") {
  std::vector<call> calls;
  hand_progress report(2.0, 12.0, record{&calls}, std::chrono::seconds(0));
  const auto infinite = std::numeric_limits<double>::infinity();
  for (const double t : {2.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    report(t);
    CHECK(calls.back().fraction == 0);
    CHECK(calls.back().left == infinite);
  }
  report(13);
  CHECK(calls.back().fraction == 1);
  CHECK(calls.size() == 4);
}

TEST_CASE("time may run backward, or not at all") {
  std::vector<call> calls;
  hand_progress back(1.0, -1.0, record{&calls}, std::chrono::seconds(0));
  hand_clock::pass(3);
  back(0.5f);
  CHECK(calls.back().fraction == 0.25);
  CHECK(calls.back().left == 9);
  hand_progress none(1.0, 1.0, record{&calls});
  none(1.0);
  CHECK(calls.back().fraction == 1);
}

TEST_CASE("progress needs finite times and an interval that is not negative") {
  std::vector<call> calls;
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(hand_progress(infinite, 1, record{&calls}), contains_text("start time must be finite"));
  CHECK_THROWS_WITH(hand_progress(0, -infinite, record{&calls}), contains_text("end time must be finite"));
  CHECK_THROWS_WITH(hand_progress(0, 1, record{&calls}, std::chrono::seconds(-1)),
                    contains_text("interval of progress must not be negative, got -1"));
}

std::string drawn(progress_bar::draw when, const std::vector<call>& calls) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
  REQUIRE(file);
  const progress_bar bar(file.get(), when);
  for (const call& c : calls) bar(c.fraction, c.elapsed, c.left);
  std::rewind(file.get());
  std::string text(1000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  return text;
}
/// The final content of a line that is overwritten, without trailing blanks.
std::string line_of(const std::string& text) {
  std::string line;
  std::size_t at = 0;
  for (const char c : text) {
    if (c == '\r') {
      at = 0;
    } else {
      line.resize(std::max(line.size(), at + 1), ' ');
      line[at++] = c;
    }
  }
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

TEST_CASE("a bar is drawn over and over on one line") {
  const auto after = [](const std::vector<call>& calls) { return line_of(drawn(progress_bar::draw::always, calls)); };
  const std::string half = std::string(20, '#') + std::string(20, ' ');
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(after({{0, 0.4, infinite}}) == "[" + std::string(40, ' ') + "]   0 %  0 s");
  CHECK(after({{0.5, 12.9, 12.9}}) == "[" + half + "]  50 %  12 s, 12 s left");
  CHECK(after({{0.5, 3600 + 125, 12005}, {0.509, 59.9, 60}}) == "[" + half + "]  50 %  59 s, 1 min 0 s left");
  CHECK(after({{0.5, 60 * 599 + 30, 1e300}}) == "[" + half + "]  50 %  9 h 59 min, 277777777 h 46 min left");
  CHECK(after({{0.999, 9, 1}}) == "[" + std::string(39, '#') + " ]  99 %  9 s, 1 s left");
  const std::string all = drawn(progress_bar::draw::always, {{0.5, 1, 1}, {1, 2, 0}});
  CHECK(line_of(all).starts_with("[" + std::string(40, '#') + "] 100 %  2 s"));
  CHECK(std::count(all.begin(), all.end(), '\r') == 2);
  CHECK(std::count(all.begin(), all.end(), '\n') == 1);
  CHECK(all.back() == '\n');
}

TEST_CASE("a bar is silent where there is no terminal") {
  CHECK(drawn(progress_bar::draw::on_terminals, {{0.5, 1, 1}, {1, 2, 0}}).empty());
}

}  // namespace progress_test
