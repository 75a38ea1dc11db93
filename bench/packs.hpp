#pragma once

#include <kte/dynamics/batch.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>

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

/// W states a call in a pack of S, of numbers that are in packs already.
template <class Model, class S, int W>
struct packed_calls {
  using pack = kte::pack<S, W>;
  struct packs {
    const S* x;
    pack operator[](std::size_t i) const { return pack::load(x + i * std::size_t{W}); }
  };
  static constexpr auto& chain = Model::chain;
  static constexpr std::size_t nq = std::remove_cvref_t<decltype(chain)>::nq,
                               nv = std::remove_cvref_t<decltype(chain)>::dofs;

  [[gnu::noinline]] static void inverse_dynamics(const S* x, S* y) {
    store(kte::inverse_dynamics(chain, packs{x}, packs{x + W * nq}, packs{x + W * (nq + nv)}), y);
  }
  [[gnu::noinline]] static void forward_dynamics(const S* x, S* y) {
    store(kte::forward_dynamics(chain, packs{x}, packs{x + W * nq}, packs{x + W * (nq + nv)}), y);
  }
  /// Registers both.
  static void add(const std::string& how) {
    bench::add(operation::inverse_dynamics, how, Model::name, inverse_dynamics, W, triangle::both, true);
    bench::add(operation::forward_dynamics, how, Model::name, forward_dynamics, W, triangle::both, true);
  }

 private:
  template <class V>
  static void store(const V& v, S* y) {
    for (Eigen::Index i = 0; i < v.size(); ++i) v[i].store(y + i * W);
  }
};

}  // namespace bench
