#pragma once

namespace kte::detail {

/// Restores a solver to a time and state if the scope is left by an exception before `arrived` is set. Without
/// exceptions enabled, it does nothing.
template <class Solver, class S, class X>
class way_back {
 public:
  way_back(Solver& solver, const S& t, const X& x) : solver_(solver), time_(t), x_(x) {}
  way_back(const way_back&) = delete;
  way_back& operator=(const way_back&) = delete;
  ~way_back() {
    if (is_open_) solver_.restart(time_, x_);
  }

  void arrived() { is_open_ = false; }

 private:
  Solver& solver_;
  const S& time_;
  const X& x_;
  bool is_open_ = true;
};

}  // namespace kte::detail
