#include <kte/dynamics/batch.hpp>

#include "catch.hpp"
#include "closed_loops/tangle.hpp"
#include "random.hpp"

namespace batch_test {

using namespace kte;
using namespace kte::test::loops;
using Catch::Matchers::Message;

/// The largest difference of a batch from single calls, relative to the largest acceleration.
template <int W>
double batch_error(const runtime_chain& c, const Eigen::MatrixXd& q, const Eigen::MatrixXd& v,
                   const Eigen::MatrixXd& tau) {
  auto s = c.make_state();
  Eigen::MatrixXd a(c.dofs(), q.cols()), expected = a;
  batch::forward_dynamics<W>(c, q, v, tau, a);
  for (Eigen::Index k = 0; k < q.cols(); ++k)
    expected.col(k) = forward_dynamics(c, s, vector(q.col(k)), vector(v.col(k)), vector(tau.col(k)));
  return (a - expected).cwiseAbs().maxCoeff() / (1 + expected.cwiseAbs().maxCoeff());
}

/// `count` states of a chain on its loops, from the first guesses that can be assembled.
struct states {
  Eigen::MatrixXd q, v, tau;
  template <class Guess>
  states(const runtime_chain& c, Eigen::Index count, const Guess& guess)
      : q(c.nq(), count), v(c.dofs(), count), tau(v) {
    random_numbers draw(7);
    auto s = c.make_state();
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto drawn = [&] { return vector::NullaryExpr(c.dofs(), [&] { return draw(); }).eval(); };
      for (bool closed = false; !closed;) try {
          q.col(k) = assemble(c, s, guess(k, drawn()));
          closed = true;
        } catch (const cannot_assemble&) {
        }
      tau.col(k) = drawn();
      v.col(k) = drawn();
      v.col(k) = consistent_velocities(c, s, vector(q.col(k)), vector(v.col(k)));
    }
  }
};

TEST_CASE("batches of chains with closures equal single calls") {
  const vec3<> u{0.6, 0, 0.8}, t{0, 1, 0};
  const auto check = [](const auto&... closure) {
    tangle x;
    ((x.closed << closure), ...);
    const states all(x.closed, 19,
                     [&](auto, const vector& d) { return integrate(x.open, neutral_configuration(x.open), d, 1.0); });
    CHECK(batch_error<8>(x.closed, all.q, all.v, all.tau) < 1e-12);
    CHECK(batch_error<2>(x.closed, all.q, all.v, all.tau) < 1e-12);
  };
  check(coincident_points_3D("l", "le", "re"));
  check(hinge_3D("l", "world", "re", u), universal_3D("m", "lb", "rc", u, t));
  check(distance_3D("l", "le", "re", 0.5), coupled_coordinates("n", "l1", "r1", 2.0, -1.0, 0.1));
}

TEST_CASE(
    "batches with redundant closures, and with states that differ in their independent rows, equal single calls") {
  for (const auto& c : {four_bars(2, true), four_bars_in_space(2)}) {
    const states all(c, 21, [](auto k, const vector&) { return four_bar_q(2, 0.3 + 0.05 * double(k)); });
    CHECK(batch_error<8>(c, all.q, all.v, all.tau) < 1e-12);
    // Horizontal, J has rank 2 instead of 4.
    const states some(c, 21,
                      [](auto k, const vector&) { return four_bar_q(2, k % 3 == 1 ? pi / 2 : 0.05 * double(k)); });
    CHECK(batch_error<8>(c, some.q, some.v, some.tau) < 1e-12);
  }
}

TEST_CASE("a batch refuses loops that are not assembled, by state and closure") {
  const auto c = four_bars(2);
  states all(c, 11, [](auto k, const vector&) { return four_bar_q(2, 0.3 + 0.05 * double(k)); });
  all.q(4, 6) += 0.1;
  Eigen::MatrixXd a(5, 11);
  CHECK_THROWS_MATCHES(batch::forward_dynamics<8>(c, all.q, all.v, all.tau, a), bad_argument,
                       Catch::Matchers::Predicate<bad_argument>([](const bad_argument& e) {
                         return std::string(e.what()).starts_with("kte: state 6: forward_dynamics: 'pin1' is open by ");
                       }));
  CHECK(a.col(6).array().isNaN().all());
  CHECK(a.col(5).allFinite());
}

TEST_CASE("a batch with closures has NaN for a state without a result, and names it") {
  const auto c = four_bars(1);
  states all(c, 11, [](auto k, const vector&) { return four_bar_q(1, 0.3 + 0.05 * double(k)); });
  all.tau(1, 4) = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd a(3, 11);
  CHECK_THROWS_MATCHES(batch::forward_dynamics<8>(c, all.q, all.v, all.tau, a), bad_argument,
                       Catch::Matchers::Predicate<bad_argument>(
                           [](const bad_argument& e) { return std::string(e.what()).starts_with("kte: state 4: "); }));
  CHECK(a.col(4).array().isNaN().all());
  CHECK(a.col(3).allFinite());
  CHECK(a.col(10).allFinite());
  CHECK_THROWS_AS(batch::inverse_dynamics<8>(c, all.q, all.v, all.v, a), bad_argument);
  CHECK_THROWS_AS(c.make_state<float>(), bad_argument);
  auto packs = c.make_state<pack<double, 4>>();
  const runtime_vector<pack<double, 4>> none = runtime_vector<pack<double, 4>>::Zero(3);
  CHECK_THROWS_AS(forward_dynamics(c, packs, none, none, none), bad_argument);
}

}  // namespace batch_test
