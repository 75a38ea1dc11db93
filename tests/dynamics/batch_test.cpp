#include <kte/dynamics/batch.hpp>

#include <atomic>
#include <limits>
#include <stdexcept>
#include <vector>

#include "catch.hpp"
#include "random.hpp"
#include "robots/iiwa14.hpp"

namespace batch_test {

namespace batch = kte::batch;

/// Small, so that tests with many widths compile quickly: joints about a typed and a general axis, and a sliding one.
constexpr auto arm = [] {
  using namespace kte;
  using namespace robots::iiwa14_names;
  constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
  return chain(revolute_joint_3D(q1, mount1, link1), inertia_3D(link1, body),
               rigid_link_3D(link1, mount2, vec3{0.1, 0.2, -0.3}, quarter_turn_x),
               revolute_joint_3D(q2, mount2, link2, vec3{0.6, 0.0, 0.8}), inertia_3D(link2, body),
               prismatic_joint_3D(q3, link2, link3, axis::y), inertia_3D(link3, body))
      .gravity(vec3{0.3, -0.4, -9.81});
}();
constexpr std::size_t n = 3;

template <class T>
struct states {
  std::vector<T> q, v, a;
  explicit states(std::size_t count, unsigned seed = 71) {
    random_numbers random(seed);
    for (std::size_t i = 0; i < n * count; ++i) {
      q.push_back(static_cast<T>(random(3)));
      v.push_back(static_cast<T>(random(2)));
      a.push_back(static_cast<T>(random(5)));
    }
  }
};
template <class T>
std::array<T, n> state(const std::vector<T>& x, std::size_t k) {
  std::array<T, n> r;
  std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(k * n), n, r.begin());
  return r;
}

template <int W, class T, class Executor = batch::in_this_thread>
std::vector<T> torques(const states<T>& s, Executor&& executor = {}) {
  std::vector<T> tau(s.q.size(), T(-1));
  batch::inverse_dynamics<W>(arm, s.q, s.v, s.a, tau, executor);
  return tau;
}

/// The largest difference of state k of a batch from x, against the largest number of x.
template <class T, class X>
double gap(const std::vector<T>& batched, std::size_t k, const X& x) {
  T difference = 0, size = 0;
  const auto m = static_cast<std::size_t>(x.size());
  for (std::size_t i = 0; i < m; ++i) {
    const T y = x.data()[i];
    difference = kte::test::worse(difference, std::fabs(batched[k * m + i] - y));
    size = std::max(size, std::fabs(y));
  }
  return static_cast<double>(difference / size);
}

/// Either result is within 5 eps of the truth, the largest number being 1: inverse_dynamics_test.cpp finds 1e-15 for
/// double.
template <class T>
constexpr double by_rounding = 10 * static_cast<double>(std::numeric_limits<T>::epsilon());

template <class F>
void for_all_widths(const F& f) {
  f.template operator()<double, 4>();
  f.template operator()<double, 8>();
  f.template operator()<float, 8>();
  f.template operator()<float, 16>();
}

template <class F>
std::string complaint(const F& f) {
  try {
    f();
  } catch (const kte::bad_argument& e) {
    return e.what();
  }
  return "";
}

/// Last task first.
struct backwards {
  template <class Task>
  void operator()(std::size_t tasks, Task&& task) const {
    while (tasks-- > 0) task(tasks);
  }
};

TEST_CASE("a batch is its states") {
  for_all_widths([]<class T, int W>() {
    CAPTURE(W, sizeof(T));
    const states<T> all(100);
    const auto together = torques<W>(all);
    for (const std::size_t count : {1U, 7U, 8U, 9U, 100U}) {
      states<T> s = all;
      for (auto* x : {&s.q, &s.v, &s.a}) x->resize(count * n);
      const auto tau = torques<W>(s);
      for (std::size_t k = 0; k < count; ++k)
        CHECK(gap(tau, k, kte::inverse_dynamics(arm, state(s.q, k), state(s.v, k), state(s.a, k))) < by_rounding<T>);
      CHECK(std::equal(tau.begin(), tau.end(), together.begin()));
    }
    for (std::size_t k = 0; k < 20; ++k) {  // each alone
      std::array<T, n> tau{};
      batch::inverse_dynamics<W>(arm, state(all.q, k), state(all.v, k), state(all.a, k), tau);
      CHECK(tau == state(together, k));
    }
  });
}

TEST_CASE("a batch by any executor") {
  for_all_widths([]<class T, int W>() {
    CAPTURE(W, sizeof(T));
    const states<T> s(2101);
    const auto tau = torques<W>(s);
    for (std::size_t threads = 1; threads <= 4; ++threads) CHECK(torques<W>(s, batch::threads(threads)) == tau);
    CHECK(torques<W>(s, backwards{}) == tau);
  });
}

TEST_CASE("mass matrices and forward dynamics in batches") {
  const auto check = []<class T>(const states<T>& s) {
    const std::size_t count = s.q.size() / n;
    std::vector<T> M(n * n * count), a(n * count);
    batch::mass_matrix(arm, s.q, M);
    batch::forward_dynamics(arm, s.q, s.v, s.a, a);
    for (std::size_t k = 0; k < count; ++k) {
      CHECK(gap(M, k, kte::mass_matrix(arm, state(s.q, k))) < by_rounding<T>);
      // The condition of M, below 1e3 for this arm, multiplies the errors of M and of the bias.
      CHECK(gap(a, k, kte::forward_dynamics(arm, state(s.q, k), state(s.v, k), state(s.a, k))) < 1e3 * by_rounding<T>);
    }
    std::vector<T> M2(M.size()), a2(a.size());
    batch::mass_matrix(arm, s.q, M2, batch::threads(2));
    batch::forward_dynamics(arm, s.q, s.v, s.a, a2, batch::threads(2));
    CHECK(M2 == M);
    CHECK(a2 == a);
  };
  check(states<double>(37));
  check(states<float>(37));
}

TEST_CASE("a batch of a robot") {
  constexpr std::size_t joints = 7;
  random_numbers random(72);
  Eigen::Matrix<double, joints, 21> q, v, a, tau;
  for (auto* x : {&q, &v, &a})
    for (auto& number : x->reshaped()) number = random(3);
  batch::inverse_dynamics(robots::iiwa14, q, v, a, tau);
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    const auto exact = kte::inverse_dynamics(robots::iiwa14, q.col(k), v.col(k), a.col(k));
    CHECK((tau.col(k) - exact).cwiseAbs().maxCoeff() <= by_rounding<double> * exact.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("batches of Eigen matrices, and in place") {
  const states<double> s(19);
  const auto tau = torques<0>(s);
  using matrix = Eigen::Matrix<double, int{n}, Eigen::Dynamic>;
  const auto view = [](const std::vector<double>& x) { return Eigen::Map<const matrix>(x.data(), n, 19); };
  matrix t(n, 19);
  batch::inverse_dynamics(arm, view(s.q), view(s.v), view(s.a), t);
  CHECK(t == view(tau));
  Eigen::MatrixXd a = view(s.a);
  batch::inverse_dynamics(arm, view(s.q), view(s.v), a, a);
  CHECK(a == view(tau));
  Eigen::MatrixXd M(n, 19 * n);
  CHECK_NOTHROW(batch::mass_matrix(arm, view(s.q), M));
  CHECK(gap(std::vector<double>(M.data(), M.data() + M.size()), 3, kte::mass_matrix(arm, state(s.q, 3))) <
        by_rounding<double>);

  const Eigen::MatrixXd large = Eigen::MatrixXd::Zero(n + 2, 19), transposed = Eigen::MatrixXd::Zero(19, n);
  CHECK_THAT(complaint([&] { batch::inverse_dynamics(arm, large.topRows(n), view(s.v), view(s.a), t); }),
             kte::test::contains_text("the numbers of q do not lie side by side"));
  CHECK_THAT(complaint([&] { batch::inverse_dynamics(arm, view(s.q), transposed, view(s.a), t); }),
             kte::test::contains_text("v has columns of 19 numbers, a state has 3"));
}

TEST_CASE("batches of no states") {
  std::vector<double> none;
  CHECK_NOTHROW(batch::inverse_dynamics(arm, none, none, none, none));
  CHECK_NOTHROW(batch::inverse_dynamics(arm, none, none, none, none, batch::threads(3)));
}

TEST_CASE("a batch with arguments of wrong sizes") {
  const states<double> s(9);
  const auto shorter = [](std::vector<double> x, std::size_t by) {
    x.resize(x.size() - by);
    return x;
  };
  std::vector<double> tau(s.q.size(), -1), M(9 * n * n, -1);
  const auto untouched = tau, untouched_M = M;
  using kte::test::contains_text;
  CHECK_THAT(complaint([&] { batch::inverse_dynamics(arm, shorter(s.q, 1), s.v, s.a, tau); }),
             contains_text("q has 26 numbers, a state has 3"));
  CHECK_THAT(complaint([&] { batch::inverse_dynamics(arm, shorter(s.q, n), s.v, s.a, tau); }),
             contains_text("v has 27 numbers, 8 states have 24"));
  CHECK_THAT(complaint([&] { batch::inverse_dynamics(arm, s.q, shorter(s.v, 2), s.a, tau); }), contains_text("v has"));
  CHECK_THAT(complaint([&] { batch::inverse_dynamics(arm, s.q, s.v, shorter(s.a, n), tau); }), contains_text("a has"));
  CHECK_THAT(complaint([&] { batch::forward_dynamics(arm, s.q, s.v, shorter(s.a, n), tau); }),
             contains_text("tau has"));
  std::vector<double> small(8 * n, -1);
  const auto untouched_small = small;
  CHECK_THAT(complaint([&] { batch::inverse_dynamics(arm, s.q, s.v, s.a, small); }), contains_text("tau has"));
  CHECK_THAT(complaint([&] { batch::forward_dynamics(arm, s.q, s.v, s.a, small); }), contains_text("a has"));
  CHECK_THAT(complaint([&] { batch::mass_matrix(arm, s.q, small); }), contains_text("M has"));
  CHECK_THAT(complaint([&] { batch::mass_matrix(arm, shorter(s.q, 1), M); }), contains_text("q has"));
  CHECK(tau == untouched);
  CHECK(M == untouched_M);
  CHECK(small == untouched_small);
  CHECK_THROWS_AS(batch::threads(0), kte::bad_argument);
}

TEST_CASE("bad states do not spoil the others") {
  for_all_widths([]<class T, int W>() {
    CAPTURE(W, sizeof(T));
    const states<T> good(2101);
    const auto truth = torques<W>(good);
    for (const std::vector<std::size_t>& bad :
         {std::vector<std::size_t>{0}, {5}, {2100}, {11, 12, 13}, {2050, 700, 1999, 701}}) {
      auto s = good;
      for (const std::size_t k : bad) {
        s.q[k * n + 1] = std::numeric_limits<T>::quiet_NaN();
        s.a[k * n + 2] = std::numeric_limits<T>::infinity();
      }
      const std::size_t first = *std::min_element(bad.begin(), bad.end());
      const auto check = [&](const auto& executor) {
        std::vector<T> tau(s.q.size(), T(-1));
        CHECK_THAT(complaint([&] { batch::inverse_dynamics<W>(arm, s.q, s.v, s.a, tau, executor); }),
                   kte::test::contains_text("kte: state " + std::to_string(first) +
                                            ": a force is not finite: q[1] of 'q2' is nan"));
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < tau.size(); ++i) {
          const bool of_bad = std::find(bad.begin(), bad.end(), i / n) != bad.end();
          wrong += of_bad ? !std::isnan(tau[i]) : tau[i] != truth[i];
        }
        CHECK(wrong == 0);
      };
      check(batch::in_this_thread{});
      check(batch::threads(3));
    }
  });
}

TEST_CASE("a batch keeps the type of what is wrong") {
  // A point mass on the axis of its joint.
  using namespace robots::iiwa14_names;
  constexpr auto c =
      kte::chain(kte::revolute_joint_3D(q1, mount1, link1, kte::axis::x), kte::inertia_3D(link1, kte::point_mass(1.0)));
  const std::vector<double> x(5, 0.1);
  std::vector<double> a(5);
  CHECK_THROWS_AS(batch::forward_dynamics(c, x, x, x, a), kte::singular_mass_matrix);
  CHECK_THROWS_WITH(batch::forward_dynamics(c, x, x, x, a), kte::test::contains_text("state 0: the mass matrix"));
}

TEST_CASE("threads do all tasks, and rethrow the first exception") {
  for (std::size_t n_threads = 1; n_threads <= 4; ++n_threads) {
    std::vector<std::atomic<int>> done(50);
    std::string what;
    try {
      batch::threads{n_threads}(done.size(), [&](std::size_t i) {
        ++done[i];
        if (i % 20 == 7) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& e) {
      what = e.what();
    }
    CHECK(what == "7");
    for (const auto& d : done) CHECK(d == 1);
  }
  CHECK_NOTHROW(batch::threads(3)(0, [](std::size_t) { throw 1; }));
}

}  // namespace batch_test
