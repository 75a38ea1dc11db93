#include <kte/tree/finite.hpp>

#include <array>
#include <deque>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "catch.hpp"

// Registers hold four numbers, or two, or eight: rows of every length up to some of them, with each number not finite
// once.

namespace finite_test {

using kte::tree::all_finite_in_row, kte::tree::stands_in_row;

template <class S>
void try_rows() {
  for (std::size_t n = 0; n < 40; ++n) {
    CAPTURE(n);
    std::vector<S> x(n + 1, std::numeric_limits<S>::max());  // whose sum would be infinite
    x[n] = std::numeric_limits<S>::quiet_NaN();              // beyond the row
    CHECK(all_finite_in_row(x.data(), n));
    bool found = true;
    for (std::size_t i = 0; i < n; ++i)
      for (const S non_finite : {std::numeric_limits<S>::infinity(), -std::numeric_limits<S>::infinity(), x[n]}) {
        const S kept = std::exchange(x[i], non_finite);
        found &= !all_finite_in_row(x.data(), n);
        x[i] = kept;
      }
    CHECK(found);
  }
}

TEST_CASE("a number that is not finite is found wherever it stands in a row") {
  try_rows<double>();
  try_rows<float>();
  try_rows<long double>();
}

TEST_CASE("rows are known where numbers stand one behind the other") {
  STATIC_REQUIRE(stands_in_row<const double*, double>);
  STATIC_REQUIRE(stands_in_row<double[3], double>);
  STATIC_REQUIRE(stands_in_row<std::array<double, 3>, double>);
  STATIC_REQUIRE(stands_in_row<std::vector<double>, double>);
  STATIC_REQUIRE(stands_in_row<std::span<const double>, double>);
  STATIC_REQUIRE(stands_in_row<Eigen::VectorXd, double>);
  STATIC_REQUIRE(stands_in_row<Eigen::Map<const Eigen::VectorXd>, double>);
  STATIC_REQUIRE(stands_in_row<Eigen::Ref<const Eigen::VectorXd>, double>);
  STATIC_REQUIRE(stands_in_row<Eigen::MatrixXd::ColXpr, double>);

  STATIC_REQUIRE_FALSE(stands_in_row<std::vector<float>, double>);
  STATIC_REQUIRE_FALSE(stands_in_row<std::vector<int>, double>);
  STATIC_REQUIRE_FALSE(stands_in_row<std::deque<double>, double>);
  STATIC_REQUIRE_FALSE(stands_in_row<Eigen::VectorXf, double>);
  STATIC_REQUIRE_FALSE(stands_in_row<Eigen::MatrixXd::RowXpr, double>);
  STATIC_REQUIRE_FALSE(stands_in_row<Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>>, double>);
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(3);
  STATIC_REQUIRE_FALSE(stands_in_row<std::remove_cvref_t<decltype(x + x)>, double>);
}

}  // namespace finite_test
