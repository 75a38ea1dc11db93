#pragma once

#include <kte/dynamics/closed_loops/loops_in_lanes.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/packs/batch.hpp>
#include <kte/runtime_chain.hpp>

#include <vector>

namespace kte::batch::detail {

/// `Function` of a runtime chain for many states, with in[i] numbers per state of input i and `out` numbers per state
/// of the result. The counterpart of `job`, whose sizes are known at compile time. Each task has its own state.
template <class Function, class P, std::size_t Inputs>
class runtime_job {
  using T = typename P::value_type;
  static constexpr std::size_t w = P::lanes;
  using vectors = std::array<kte::runtime_vector<P>, Inputs>;

 public:
  struct input {
    const T* numbers;
    std::size_t a_state;
  };

  runtime_job(const runtime_chain& chain, std::size_t count, T* out, std::size_t a_result,
              const std::array<input, Inputs>& in)
      : chain_(chain), count_(count), out_(out), a_result_(a_result), in_(in), made_(chain.make_state<P>()) {
    if (chain.lanes() > 1)
      throw bad_argument("kte: a batch is of states of one chain; this one has other parameters in each lane");
  }

  std::size_t tasks() const { return (count_ + chunk - 1) / chunk; }
  void operator()(std::size_t task) {
    basic_runtime_state<P> s = made_;
    vectors x;
    for (std::size_t i = 0; i < Inputs; ++i) x[i].resize(static_cast<Eigen::Index>(in_[i].a_state));
    const std::size_t last = (std::min)((task + 1) * chunk, count_);
    for (std::size_t first = task * chunk; first < last; first += w)
      if (!together(first, (std::min)(w, last - first), s, x)) one_by_one(first, (std::min)(w, last - first), s, x);
  }
  void raise() const { failure_.raise(); }

 private:
  static constexpr std::size_t chunk = 64 * w;

  /// Evaluates states first, first + 1, ... together, repeating the last to fill a pack. Returns whether all have
  /// results.
  bool together(std::size_t first, std::size_t count, basic_runtime_state<P>& s, vectors& x) {
    take(first, count, x);
    try {
      write(Function::of(chain_, s, x), first, count);
    } catch (const error&) {
      return false;
    }
    return true;
  }
  [[gnu::cold]] void one_by_one(std::size_t first, std::size_t count, basic_runtime_state<P>& s, vectors& x) {
    for (std::size_t k = first; k < first + count; ++k) {
      take(k, 1, x);
      try {
        write(Function::of(chain_, s, x), k, 1);
      } catch (const error& e) {
        failure_.at(k, e);
        std::fill_n(out_ + k * a_result_, a_result_, std::numeric_limits<T>::quiet_NaN());
      }
    }
  }
  void take(std::size_t first, std::size_t count, vectors& x) const {
    for (std::size_t i = 0; i < Inputs; ++i) {
      const auto [numbers, n] = in_[i];
      for (std::size_t lane = 0; lane < w; ++lane) {
        const T* const from = numbers + (first + (std::min)(lane, count - 1)) * n;
        for (std::size_t c = 0; c < n; ++c) x[i][static_cast<Eigen::Index>(c)].set(lane, from[c]);
      }
    }
  }
  template <class Result>
  void write(const Result& r, std::size_t first, std::size_t count) const {
    for (std::size_t lane = 0; lane < count; ++lane) {
      T* const to = out_ + (first + lane) * a_result_;
      for (std::size_t c = 0; c < a_result_; ++c) to[c] = r.data()[c][lane];
    }
  }

  const runtime_chain& chain_;
  std::size_t count_;
  T* out_;
  std::size_t a_result_;
  std::array<input, Inputs> in_;
  basic_runtime_state<P> made_;
  failure failure_;
};

struct runtime_inverse_dynamics {
  template <class P, class X>
  static const auto& of(const runtime_chain& c, basic_runtime_state<P>& s, const X& x) {
    return kte::inverse_dynamics(c, s, x[0], x[1], x[2]);
  }
};
struct runtime_forward_dynamics {
  template <class P, class X>
  static const auto& of(const runtime_chain& c, basic_runtime_state<P>& s, const X& x) {
    kte::detail::enable_loops_in_lanes<P>();
    return kte::forward_dynamics(c, s, x[0], x[1], x[2]);
  }
};
struct runtime_mass_matrix {
  template <class P, class X>
  static const auto& of(const runtime_chain& c, basic_runtime_state<P>& s, const X& x) {
    return kte::mass_matrix(c, s, x[0]);
  }
};

}  // namespace kte::batch::detail
