#pragma once

#include <Eigen/Core>

#include "data/problems/error.hpp"

namespace kte::problems {

/// Andrews' squeezing mechanism, seven bodies in the plane with three loops and one degree of freedom, as an equation
/// for the angle beta of its crank: with J the inertia of all bodies seen by the crank and Q the moment of motor and
/// spring on it (Eksergian's equation),
///
///   J beta'' = Q - J_beta beta'^2 / 2                                                        (1)
///   J = sum m |c_beta|^2 + I phi_beta^2,   J_beta / 2 = sum m c_beta . c_beta,beta + I phi_beta phi_beta,beta    (2)
///
/// where _beta is the derivative by beta. Positions are closed by intersection of circles, so the loops do not drift.
/// State: beta, beta'; s, rad, kg, m; no gravity. A step needs less than 1 ms.
///
/// Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, VII.7: seven angles with multipliers. The
/// vector that test sets give for 0.03 s is good to about 10 digits of beta and beta', and 7 of their accelerations.
template <class S = double>
struct andrews {
  static constexpr const char* name = "Andrews' squeezer";
  static constexpr int size = 2;
  static constexpr long double t_end = 0.03L;
  using state = Eigen::Matrix<S, size, 1>;

  static state start() { return {S(-0.0617138900142764496358948458001L), S(0)}; }
  state operator()(const S&, const state& x) const {
    const motion m(x[0]);
    return {x[1], S((m.moment - m.half_slope * x[1] * x[1]) / m.inertia)};  // (1)
  }
  /// Kinetic and of the spring, less the work of the motor, J; constant: 1.437832957532139872622884772823.
  S energy(const state& x) const {
    const motion m(x[0]);
    const S stretch = m.spring - number(0.07785L);
    return m.inertia * x[1] * x[1] / 2 + number(4530) * stretch * stretch / 2 - number(0.033L) * x[0];
  }

  /// Integrated twice at 60 digits with multipliers; only digits on which both agree.
  static constexpr known<2> references[2]{
      {0.01L, {2.16011313153152650618473946916L, 711.923152831103979063582147286L}},
      {0.03L, {15.8107711951537070971193873047L, 1139.92030225910606419809684778L}}};
  static constexpr const auto& reference = references[1].values;

 private:
  using vector = Eigen::Matrix<S, 2, 1>;
  static S number(long double x) { return S(x); }
  static vector left_of(const vector& n) { return {S(-n[1]), n[0]}; }

  /// A point and its first and second derivative by beta.
  struct point {
    vector at, d, dd;
    friend point operator+(const point& a, const point& b) { return {a.at + b.at, a.d + b.d, a.dd + b.dd}; }
    friend point operator-(const point& a, const point& b) { return {a.at - b.at, a.d - b.d, a.dd - b.dd}; }
    friend point operator-(const point& a, const vector& b) { return {a.at - b, a.d, a.dd}; }
  };
  /// A direction of a body, and the derivatives of its angle.
  struct arm {
    vector n;
    S d, dd;
    /// The point at distance `along` on it, and `left` to the left.
    point operator()(const S& along, const S& left = S(0)) const {
      const vector p = along * n + left * left_of(n);
      return {p, d * left_of(p), dd * left_of(p) - d * d * p};
    }
  };
  /// Two arms of lengths a, b that reach w: w = a n_a + b n_b, the first on the left of w (side = 1) or right (-1).
  struct dyad {
    arm first, second;

    dyad(const point& w, const S& a, const S& b, int side) {
      using std::sqrt;
      const S square = w.at.squaredNorm(), along = (square + a * a - b * b) / (2 * square);
      const S across = S(side) * sqrt(S(a * a / square - along * along));
      first.n = (along * w.at + across * left_of(w.at)) / a;
      second.n = (w.at - a * first.n) / b;
      turn(w.d, a, b, first.d, second.d);
      turn(w.dd + a * first.d * first.d * first.n + b * second.d * second.d * second.n, a, b, first.dd, second.dd);
    }

   private:
    /// w = a x left_of(n_a) + b y left_of(n_b) for x and y.
    void turn(const vector& w, const S& a, const S& b, S& x, S& y) const {
      const S area = second.n.dot(left_of(first.n));
      x = second.n.dot(w) / (a * area);
      y = -first.n.dot(w) / (b * area);
    }
  };

  /// J, J_beta / 2, Q, and the length of the spring.
  struct motion {
    S inertia{0}, half_slope{0}, moment, spring;

    explicit motion(const S& beta) {
      using std::cos, std::sin;
      const vector A(number(-0.06934L), number(-0.00227L)), B(number(-0.03635L), number(0.03273L)),
          C(number(0.014L), number(0.072L));
      const S d = number(0.028L), e = number(0.02L), zt = number(0.04L), zf = number(0.02L), u = number(0.04L);
      // The loops, by the names of the book: F is at the end of the crank, E where the three arms meet, seen from A.
      const arm crank{{cos(beta), sin(beta)}, S(1), S(0)};
      const point F = crank(number(0.007L));
      const dyad k23(F - B, d, number(0.035L), 1);
      const point E = F - k23.first(d) - A;
      const dyad k54(E, zt, e, 1), k76(E, u, zf, -1);
      // Bodies K1 to K7
      body(0.04325L, crank(number(0.00092L)), 2.194e-6L, crank);
      body(0.00365L, F - k23.first(number(0.0115L)), 4.410e-7L, k23.first);
      body(0.02373L, k23.second(number(0.01874L), number(0.01043L)), 5.255e-6L, k23.second);
      body(0.00706L, k54.first(zt) + k54.second(S(e - number(0.01421L))), 5.667e-7L, k54.second);
      body(0.07050L, k54.first(number(0.02308L), number(0.00916L)), 1.169e-5L, k54.first);
      body(0.00706L, k76.first(u) + k76.second(S(zf - number(0.01421L))), 5.667e-7L, k76.second);
      body(0.05498L, k76.first(number(0.01228L), number(0.00449L)), 1.912e-5L, k76.first);
      const point D = k23.second(number(0.018L), number(0.02L));
      const vector stretched = B + D.at - C;
      spring = stretched.norm();
      moment = number(0.033L) - number(4530) * (1 - number(0.07785L) / spring) * stretched.dot(D.d);
    }

   private:
    void body(long double mass, const point& c, long double about_c, const arm& phi) {  // (2)
      inertia += number(mass) * c.d.squaredNorm() + number(about_c) * phi.d * phi.d;
      half_slope += number(mass) * c.d.dot(c.dd) + number(about_c) * phi.d * phi.dd;
    }
  };
};

}  // namespace kte::problems
