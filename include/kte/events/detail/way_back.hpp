#pragma once

namespace kte::detail {

/// Puts a solver back to a time and state where a function throws that looks at the step after them, or acts in it:
/// unless `arrived`, when this ends. Built without exceptions, it does nothing.
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
