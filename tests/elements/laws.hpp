#pragma once

#include <kte/testing/element_laws.hpp>

#include <limits>

#include "digits50.hpp"
#include "random.hpp"

/// The laws of elements at double and at 50 digits.
namespace kte::test {

template <class S>
const S eps = std::numeric_limits<S>::epsilon();

/// Each value of a law is a sum of products of a few entries of size 1 and of terms of size 1 along at most four
/// matrix products: some 30 roundings of eps/2, relative to a result of size 1 (or the larger sum of its terms).
template <class S>
const S rounding = 16 * std::numeric_limits<S>::epsilon();  // not by eps: their order of initialisation is open

/// By five points, h = eps^(1/6): rounding of p and R, a few eps each, is summed with weights 64/12 and divided by h^2,
/// which gives 10 times 3 eps^(2/3); the terms left out are h^4/90 of the sixth derivative, which for motions as tried
/// here is below 1e3.
template <class S>
const S by_differences = [] {
  using std::pow;
  return S(50 * pow(std::numeric_limits<S>::epsilon(), S(2) / S(3)));
}();

/// An element with its own random state.
template <class S = double, class Element>
auto trial_of(const Element& e, unsigned seed) {
  random_numbers draw(seed);
  testing::detail::trial<S, typename Element::core_type> x(e.core, draw);
  if constexpr (Element::core_type::ports.back().how == access::out) x.doMotion();
  return x;
}

/// Whether two vectors agree to a tolerance; NaN agrees with nothing.
template <class S, class A, class B>
bool near(const A& a, const B& b, const S& tolerance) {
  const auto d = as<S>(as<S>(a) - as<S>(b));
  const auto small = [&tolerance](const S& x) { return x <= tolerance && x >= -tolerance; };
  return small(d.x) && small(d.y) && small(d.z);
}

/// The largest difference of loads on frames, relative to the largest load or 1.
template <class A, class B>
auto load_difference(const A& a, const B& b) {
  using S = std::remove_cvref_t<decltype(a.position.x)>;
  const auto numbers = [](const auto& x) {
    const auto w = load_of(x);
    const auto f = as<S>(w.force), t = as<S>(w.torque);
    return std::array<S, 6>{f.x, f.y, f.z, t.x, t.y, t.z};
  };
  return testing::detail::difference<S, 6>(numbers(a), numbers(b));
}

/// How much the loads of an element between two frames change, in axes of the frames, when both are moved by one more
/// rigid motion: they should not.
template <class S, class Element>
S change_when_moved(const Element& e, random_numbers& draw) {
  using trial = testing::detail::trial<S, typename Element::core_type>;
  S worst(0);
  for (int i = 0; i < 20; ++i) {
    trial x(e.core, draw), world(e.core, draw);
    auto y = x;
    y.for_each([&world](const port&, auto& frame) {
      const auto moved = compose(spatial(world.template at<0>()), spatial(frame));
      set_motion(frame, moved);
    });
    x.doForce(), y.doForce();
    worst = testing::detail::worse(worst, load_difference(x.template at<0>(), y.template at<0>()));
    worst = testing::detail::worse(worst, load_difference(x.template at<1>(), y.template at<1>()));
  }
  return worst;
}
/// How far the loads of an element between two frames in the plane are from those of its like in space.
template <class S, class Flat, class Solid>
S planar_difference(const Flat& flat, const Solid& solid, random_numbers& draw) {
  S worst(0);
  for (int i = 0; i < 20; ++i) {
    testing::detail::trial<S, typename Flat::core_type> x(flat.core, draw);
    testing::detail::trial<S, typename Solid::core_type> y(solid.core, draw);
    set_motion(y.template at<0>(), spatial(x.template at<0>()));
    set_motion(y.template at<1>(), spatial(x.template at<1>()));
    x.doForce(), y.doForce();
    worst = testing::detail::worse(worst, load_difference(x.template at<0>(), y.template at<0>()));
    worst = testing::detail::worse(worst, load_difference(x.template at<1>(), y.template at<1>()));
  }
  return worst;
}
/// The energy of an element, of what it is connected to in a state.
template <class Element>
auto energy_of(const Element& e) {
  return [core = e.core](const auto& a, const auto& b) {
    if constexpr (testing::detail::frame<std::remove_cvref_t<decltype(a)>>) {
      return core.potential_energy(spatial(a), spatial(b));
    } else {
      return core.potential_energy(a, b);
    }
  };
}

/// A number and its derivative, to see that derivatives go through an element.
struct sloped {
  double value = 0;
  double slope = 0;
  constexpr sloped() = default;
  constexpr sloped(double v, double d = 0) : value(v), slope(d) {}  // NOLINT(google-explicit-constructor)

  friend constexpr sloped operator-(const sloped& a) { return {-a.value, -a.slope}; }
  friend constexpr sloped operator+(const sloped& a, const sloped& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend constexpr sloped operator-(const sloped& a, const sloped& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend constexpr sloped operator*(const sloped& a, const sloped& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend constexpr sloped operator/(const sloped& a, const sloped& b) {
    const double q = a.value / b.value;
    return {q, (a.slope - q * b.slope) / b.value};
  }
  friend constexpr bool operator==(const sloped& a, const sloped& b) { return a.value == b.value; }
  friend constexpr bool operator<(const sloped& a, const sloped& b) { return a.value < b.value; }
  friend constexpr bool operator>(const sloped& a, const sloped& b) { return a.value > b.value; }
  friend sloped sqrt(const sloped& a) { return {std::sqrt(a.value), a.slope / (2 * std::sqrt(a.value))}; }
  friend sloped atan2(const sloped& s, const sloped& c) {
    const double n = s.value * s.value + c.value * c.value;
    return {std::atan2(s.value, c.value), (s.slope * c.value - s.value * c.slope) / n};
  }
};

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();

/// The text of the error that f throws, "" if it throws none.
template <class F>
std::string complaint(const F& f) {
  try {
    f();
  } catch (const error& e) {
    return e.what();
  }
  return "";
}

}  // namespace kte::test
