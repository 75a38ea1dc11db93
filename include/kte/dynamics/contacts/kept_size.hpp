#pragma once

#include <Eigen/Core>

#include <new>
#include <vector>

namespace kte::detail {

/// A dynamic matrix or vector that keeps its memory when its size changes, as it does with the contacts that touch.
template <class M>
class kept_size : public Eigen::Map<M> {
  using map = Eigen::Map<M>;

 public:
  kept_size() : map(nullptr, 0, M::ColsAtCompileTime == 1 ? 1 : 0) {}
  kept_size(const kept_size& x) : kept_size() { *this = x; }
  kept_size& operator=(const kept_size& x) {  // NOLINT(bugprone-unhandled-self-assignment)
    return *this = static_cast<const map&>(x);
  }
  template <class X>
  kept_size& operator=(const Eigen::MatrixBase<X>& x) {
    resize(x.rows(), x.cols()), map::operator=(x);
    return *this;
  }
  /// The numbers are lost.
  void resize(Eigen::Index rows, Eigen::Index columns = 1) {
    const auto size = static_cast<std::size_t>(rows * columns);
    if (numbers_.size() < size) numbers_.resize(size);
    ::new (static_cast<map*>(this)) map(numbers_.data(), rows, columns);
  }
  using map::setZero;
  void setZero(Eigen::Index rows, Eigen::Index columns = 1) { resize(rows, columns), map::setZero(); }

 private:
  std::vector<typename M::Scalar> numbers_;
};

}  // namespace kte::detail
