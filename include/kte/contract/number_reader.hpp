#pragma once

#include <kte/contract/record.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

/// Reads parameters from the numbers of a record.
namespace kte::detail {

/// The place of a value, for messages.
struct record_place {
  std::string text;
  [[noreturn]] void fail(const std::string& why) const { throw bad_file("kte: " + text + ": " + why); }
};

/// Reads numbers into a parameter. Its typed constants must have exactly the values read.
class number_reader {
 public:
  number_reader(std::span<const double> values, const record_place& place) : values_(values), place_(place) {}

  template <int N>
  void operator()(constant<N>&) {
    const double x = next();
    if (x != N) place_.fail("holds " + number(x) + ", but the static chain has " + std::to_string(N) + " by its type");
  }
  void operator()(bool& x) {
    if (!(x = next() == 1)) place_.fail("must be 1 where it is given");
  }
  template <kte::variable T>
  void operator()(T& x) {
    x = T(next());
  }
  template <std::size_t N>
  void operator()(std::array<double, N>& list) {
    for (double& x : list) x = next();
  }
  void operator()(std::vector<double>& list) {
    list.assign(values_.begin(), values_.end());
    values_ = {};
  }
  template <class X, class Y, class Z>
  void operator()(vec3<X, Y, Z>& v) {
    (*this)(v.x), (*this)(v.y), (*this)(v.z);
  }
  template <class... R>
  void operator()(mat3<R...>& m) {
    (*this)(m.x), (*this)(m.y), (*this)(m.z);
  }
  template <class... T>
  void operator()(sym3<T...>& m) {
    (*this)(m.xx), (*this)(m.xy), (*this)(m.xz), (*this)(m.yy), (*this)(m.yz), (*this)(m.zz);
  }
  void operator()(no_rotation&) {
    auto m = matrix(no_rotation{});
    (*this)(m);
  }
  template <class C, class S>
  void operator()(rotation_2D<C, S>& r) {
    const auto m = dense_matrix();
    if (m != as<double>(matrix(rotation_2D{m.x.x, m.y.x}))) place_.fail("holds a rotation out of the plane");
    number_reader({&m.x.x, 1}, place_)(r.cos);
    number_reader({&m.y.x, 1}, place_)(r.sin);
  }
  template <class S>
  void operator()(unit_quaternion<S>& q) {
    q = as<S>(to_quaternion(dense_matrix()));
  }
  /// Checks that all numbers have been read.
  void finish() const {
    if (!values_.empty()) place_.fail("holds " + std::to_string(values_.size()) + " numbers too many");
  }

 private:
  double next() {
    if (values_.empty()) place_.fail("holds too few numbers");
    const double x = values_.front();
    values_ = values_.subspan(1);
    return x;
  }
  mat3<vec3<>> dense_matrix() {
    mat3<vec3<>> m{};
    (*this)(m);
    return m;
  }
  std::span<const double> values_;
  const record_place& place_;
};

}  // namespace kte::detail
