#include <kte/view/svg/plot/axis.hpp>
#include <kte/view/svg/plot/axis_label.hpp>

#include "catch.hpp"

namespace svg_ticks_test {

using namespace kte::detail::svg;

std::string labels(const tick_list& list) {
  std::string s;
  for (const auto& t : list.ticks)
    if (const auto text = t.label.plain(); !text.empty()) s.append(s.empty() ? "" : " ").append(text);
  return s;
}
std::vector<double> values(const tick_list& list) {
  std::vector<double> v;
  for (const auto& t : list.ticks) v.push_back(t.value);
  return v;
}
number_range range_of(const std::vector<double>& numbers) {
  number_range r;
  for (const double x : numbers) r.add(x);
  return r;
}
/// An axis of 100 mm.
plot_axis axis_of(number_range r, bool logarithmic = false) { return {r, logarithmic, 0, 100}; }

constexpr double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();

TEST_CASE("ticks are 1, 2 or 5 times a power of ten, and labels their digits") {
  CHECK(labels(linear_ticks(0, 10, 6)) == "0 2 4 6 8 10");
  CHECK(values(linear_ticks(0, 1, 6)) == std::vector{0.0, 0.2, 0.4, 0.6, 0.8, 1.0});
  CHECK(labels(linear_ticks(-1, 1, 5)) == "−1.0 −0.5 0.0 0.5 1.0");
  CHECK(labels(linear_ticks(0.3, 0.7, 5)) == "0.3 0.4 0.5 0.6 0.7");
  CHECK(labels(linear_ticks(-0.11, 0.73, 6)) == "0.0 0.2 0.4 0.6");
  CHECK(labels(linear_ticks(0, 10, 1)) == "0");
}

TEST_CASE("small and large numbers have a factor of thousands in common") {
  auto list = linear_ticks(0, 5e-5, 6);
  CHECK(list.exponent == -6);
  CHECK(labels(list) == "0 10 20 30 40 50");
  list = linear_ticks(0, 4e7, 5);
  CHECK(list.exponent == 6);
  CHECK(labels(list) == "0 10 20 30 40");
  CHECK(linear_ticks(0, 99999, 6).exponent == 0);
  CHECK(linear_ticks(0, 0.004, 5).exponent == 0);
  list = linear_ticks(0, 4e-300, 5);
  CHECK(list.exponent == -300);
  CHECK(values(list) == std::vector{0.0, 1e-300, 2e-300, 3e-300, 4e-300});
  list = linear_ticks(-1e300, 1e300, 5);
  CHECK(list.exponent == 300);
  CHECK(labels(list) == "−1.0 −0.5 0.0 0.5 1.0");
}

TEST_CASE("numbers that differ in late digits have the others in common") {
  auto list = linear_ticks(1e6, 1e6 + 50, 6);
  CHECK(list.offset == "1000000");
  CHECK(labels(list) == "0 10 20 30 40 50");
  CHECK(list.ticks[1].value == 1000010);
  list = linear_ticks(-12.5 - 1e-9, -12.5 + 1e-9, 5);
  CHECK(list.offset == "−12.5");
  CHECK(list.exponent == -9);
  CHECK(labels(list) == "−1.0 −0.5 0.0 0.5 1.0");
  CHECK(axis_label("energy", "J", list).plain() == "energy + 12.5 (10^−9 J)");
  CHECK(axis_label("", "", linear_ticks(1e6, 1e6 + 50, 6)).plain() == "value − 1000000");
  CHECK(axis_label("q", "rad", linear_ticks(0, 1, 6)).plain() == "q (rad)");
}

TEST_CASE("the widest and the narrowest ranges of doubles have ticks within them") {
  for (const auto& r : std::vector<std::vector<double>>{{-most, most},
                                                        {0, most},
                                                        {most / 2, most},
                                                        {0, least * 100},
                                                        {-least * 1000, 0},
                                                        {1, 1 + 1e-11},
                                                        {-1e308, 1e-308},
                                                        {1e-308, 2e-308}}) {
    const auto shown = shown_range(range_of(r), 0.04);
    for (const std::size_t n : {1, 2, 5, 10}) {
      const auto axis = axis_of(shown);
      const auto list = axis.ticks(n);
      CAPTURE(shown.low, shown.high, n);
      CHECK(list.ticks.size() <= n);
      if (n >= 5) CHECK(list.ticks.size() >= 2);
      for (const auto& t : list.ticks) {
        CHECK(std::isfinite(t.value));
        CHECK(axis(t.value) >= -1e-6);
        CHECK(axis(t.value) <= 100 + 1e-6);
        CHECK(t.label.plain().size() < 16);
      }
    }
  }
}

TEST_CASE("constant data have an axis around them") {
  for (const double x : {0.0, 1.0, -3e5, 1e-300, 1e300, -most, most, least, -least}) {
    const auto shown = shown_range(range_of({x, x}), 0.04);
    CAPTURE(x);
    CHECK(shown.low < shown.high);
    CHECK(shown.low <= x);
    CHECK(x <= shown.high);
    const auto axis = axis_of(shown);
    CHECK(axis.ticks(6).ticks.size() >= 2);
    CHECK(axis(x) >= 0);
    CHECK(axis(x) <= 100);
    CHECK((std::abs(x) == most || axis(x) == within(50, 1e-6)));
  }
  const auto nearly = shown_range(range_of({5, std::nextafter(5, 6)}), 0.04);  // rounding, not motion
  CHECK(nearly.high - nearly.low == within(1, 1e-9));
}

TEST_CASE("no numbers at all have an axis") {
  const auto r = range_of({std::nan(""), INFINITY, -INFINITY});
  CHECK(r.empty());
  CHECK(shown_range(r, 0.04).high == 1);
  CHECK(shown_logarithmic_range(r, 0.04).high == 10);
}

TEST_CASE("logarithmic axes have powers of ten, and small ticks between them") {
  auto list = logarithmic_ticks(1e-6, 1e2, 10);
  CHECK(labels(list) == "10^−6 10^−5 10^−4 10^−3 10^−2 10^−1 10^0 10^1 10^2");
  CHECK(list.ticks.size() == 8 * 9 + 1);
  CHECK(labels(logarithmic_ticks(0.1, 100, 8)) == "0.1 1 10 100");
  CHECK(labels(logarithmic_ticks(0.5, 20, 8)) == "0.5 1 2 5 10 20");
  CHECK(labels(logarithmic_ticks(2e5, 3e6, 8)) == "2·10^5 5·10^5 10^6 2·10^6");
  CHECK(labels(logarithmic_ticks(1e-16, 1, 5)) == "10^−15 10^−10 10^−5 10^0");
  CHECK(labels(logarithmic_ticks(2, 5, 4)) == "2 3 4 5");
  list = logarithmic_ticks(least, most, 8);
  CHECK(labels(list) == "10^−300 10^−200 10^−100 10^0 10^100 10^200 10^300");
  const auto axis = axis_of({1e-300, 1e300}, true);
  CHECK(axis(1) == within(50, 1e-9));
  CHECK(axis(1e-300) == within(0, 1e-9));
  CHECK_FALSE(axis.has(0));
  CHECK_FALSE(axis.has(-1));
  CHECK_FALSE(axis.has(std::nan("")));
  const auto one = shown_logarithmic_range(range_of({3, 3}), 0.04);
  CHECK(one.low < 1);
  CHECK(one.high > 9);
}

TEST_CASE("labels of a horizontal axis have room") {
  for (const double length : {5.0, 20.0, 60.0, 150.0}) {
    const plot_axis axis({0, 1}, false, 0, length);
    const auto list = fitting_ticks(axis, 3);
    double taken = 0;
    for (const auto& t : list.ticks) taken += (t.label.width() + 0.5) * 3;
    CHECK((list.ticks.size() == 1 || taken <= length + 20));
  }
  CHECK(fitting_ticks(plot_axis({0, 1}, false, 0, 150), 3).ticks.size() == 6);
}

}  // namespace svg_ticks_test
