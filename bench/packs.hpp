#pragma once

#include <kte/dynamics/batch.hpp>

#include <span>

#include "timing.hpp"

namespace bench {

/// 512 states a call, W at a time in a pack of S, by kte::batch: from rows of numbers in memory to rows of numbers.
template <class Model, class S, int W>
struct pack_calls {
  static constexpr auto& chain = Model::chain;
  static constexpr int states = 512;
  static constexpr std::size_t nq = std::remove_cvref_t<decltype(chain)>::nq,
                               nv = std::remove_cvref_t<decltype(chain)>::dofs;

  [[gnu::noinline]] static void inverse_dynamics(const S* x, S* y) {
    kte::batch::inverse_dynamics<W>(chain, q(x), v(x), a(x), std::span(y, states * nv));
  }
  [[gnu::noinline]] static void mass_matrix(const S* x, S* y) {
    kte::batch::mass_matrix<W>(chain, q(x), std::span(y, states * nv * nv));
  }
  [[gnu::noinline]] static void forward_dynamics(const S* x, S* y) {
    kte::batch::forward_dynamics<W>(chain, q(x), v(x), a(x), std::span(y, states * nv));
  }

 private:
  static std::span<const S> q(const S* x) { return {x, states * nq}; }
  static std::span<const S> v(const S* x) { return {x + states * nq, states * nv}; }
  static std::span<const S> a(const S* x) { return {x + states * (nq + nv), states * nv}; }
};

}  // namespace bench
