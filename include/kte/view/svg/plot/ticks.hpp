#pragma once

#include <kte/view/svg/raised_text.hpp>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

/// Ticks of axes. Valid for all doubles, including the smallest and the largest.
namespace kte::detail::svg {

struct tick {
  double value;
  raised_text label;  ///< empty for a minor tick
};
/// Labels show (value - offset) / 10^exponent.
struct tick_list {
  std::vector<tick> ticks;
  std::string offset{};  ///< empty if there is none
  int exponent = 0;
};

/// n 10^k, rounded once; 0 or infinity beyond the range.
inline double decimal_number(long long n, int k) {
  const std::string text = std::to_string(n) + "e" + std::to_string(k);
  double x{};
  if (std::from_chars(text.data(), text.data() + text.size(), x).ec != std::errc{})
    x = k < 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), static_cast<double>(n));
  return x;
}
/// n 10^k in digits, with the zeros it requires.
inline std::string decimal_text(long long n, int k) {
  std::string digits = std::to_string(n < 0 ? -n : n);
  if (n != 0 && k > 0) digits.append(static_cast<std::size_t>(k), '0');
  if (k < 0) {
    const auto decimals = static_cast<std::size_t>(-k);
    if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
    digits.insert(digits.size() - decimals, ".");
  }
  return (n < 0 ? "−" : "") + digits;
}

/// The number without trailing zeros.
inline std::string shortest_decimal_text(long long n, int k) {
  while (n != 0 && k < 0 && n % 10 == 0) n /= 10, ++k;
  return decimal_text(n, k);
}

/// Numbers m, m + step, ... of a range, in units of 10^power.
struct decimal_steps {
  long long first, last, step;
  int power;
  long long largest() const { return (std::max)(first < 0 ? -first : first, last < 0 ? -last : last); }
};
/// Steps of 1, 2 or 5 in the last digit, at most `most` of them. The range must exceed its rounding errors.
inline decimal_steps steps_between(double low, double high, std::size_t most) {
  const double width = std::log10(high / 2 - low / 2) + std::log10(2.0);
  decimal_steps found{};
  for (int power = static_cast<int>(std::floor(width)) - 2;; ++power) {
    for (const long long step : {1, 2, 5}) {
      const double size = decimal_number(step, power);
      if (size == 0) continue;
      const double from = low / size, to = high / size, slack = 1e-9 + 4e-16 * (std::max)(std::abs(from), std::abs(to));
      if (!(slack < 0.1)) continue;  // steps below the precision of doubles
      const auto first = static_cast<long long>(std::ceil(from - slack));
      const auto last = static_cast<long long>(std::floor(to + slack));
      found = {first * step, last * step, step, power};
      if (last - first < static_cast<long long>(most)) return found;
    }
  }
}

/// The roundest of the numbers.
inline long long roundest(const decimal_steps& s) {
  for (long long unit = 1000000000000000000; unit > 1; unit /= 10) {
    const long long n = (s.last >= 0 ? s.last / unit : -((unit - 1 - s.last) / unit)) * unit;
    if (n >= s.first) return n;
  }
  return s.first;
}

/// At most `most` ticks of a linear axis. Labels have at most five digits: larger numbers get a factor that is a power
/// of 1000, or a common offset that is subtracted from the labels.
inline tick_list linear_ticks(double low, double high, std::size_t most) {
  const auto s = steps_between(low, high, most);
  tick_list list;
  long long offset = 0;
  if (s.largest() >= 100000) offset = roundest(s), list.offset = shortest_decimal_text(offset, s.power);
  const decimal_steps shown{s.first - offset, s.last - offset, s.step, s.power};
  const int order = static_cast<int>(std::to_string(shown.largest()).size()) - 1 + s.power;  // of the largest
  if (shown.largest() > 0 && (order >= 5 || order < -3)) list.exponent = (order >= 0 ? order : order - 2) / 3 * 3;
  const int digits = shown.largest() == 0 ? 0 : s.power - list.exponent;
  for (long long n = s.first; n <= s.last; n += s.step) {
    const double x = decimal_number(n, s.power);
    if (std::isfinite(x)) list.ticks.push_back({x, {decimal_text(n - offset, digits)}});
  }
  return list;
}

/// Powers of ten and, if there is room, ticks between them, for a range of positive numbers.
inline tick_list logarithmic_ticks(double low, double high, std::size_t most) {
  const double from = std::log10(low), to = std::log10(high);
  if (to - from < 1) return linear_ticks(low, high, most);
  const int first = static_cast<int>(std::ceil(from - 1e-9)), last = static_cast<int>(std::floor(to + 1e-9));
  int stride = 1;
  for (const int wider : {2, 3, 5, 10, 20, 50, 100, 200, 500})
    if ((last - first) / stride >= static_cast<int>(most)) stride = wider;
  const bool plain = first - 1 >= -3 && last <= 4, between = stride == 1 && last - first < 3 && most >= 4;
  tick_list list;
  const auto add = [&](int digit, int power, bool labelled) {
    const double x = decimal_number(digit, power);
    if (!(x >= low * (1 - 1e-9) && x <= high * (1 + 1e-9))) return;
    raised_text label;
    if (labelled && plain)
      label.before = decimal_text(digit, power);
    else if (labelled)
      label = {digit == 1 ? "10" : std::to_string(digit) + "·10", signed_text(power)};
    list.ticks.push_back({x, std::move(label)});
  };
  for (int power = first - 1; power <= last; ++power) {
    const bool large = power % stride == 0;
    if (power >= first && (large || last - first <= 40)) add(1, power, large);
    if (stride == 1)
      for (int digit = 2; digit < 10; ++digit) add(digit, power, between && (digit == 2 || digit == 5));
  }
  return list;
}

}  // namespace kte::detail::svg
