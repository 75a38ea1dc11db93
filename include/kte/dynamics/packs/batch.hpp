#pragma once

#include <kte/dynamics/packs/transpose.hpp>
#include <kte/errors.hpp>
#include <kte/math/pack.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <mutex>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

/// Processes a batch of states by a function of packs.
namespace kte::batch::detail {

/// The first state without a result, and the reason.
class failure {
 public:
  void at(std::size_t state, const error& e) {
    const std::lock_guard lock(guard_);
    if (state >= state_) return;
    state_ = state;
    singular_ = dynamic_cast<const singular_mass_matrix*>(&e) != nullptr;
    std::string_view why = e.what();
    if (why.substr(0, 5) == "kte: ") why.remove_prefix(5);
    what_ = "kte: state " + std::to_string(state) + ": " + std::string(why);
  }
  void raise() const {
    if (state_ == none) return;
    if (singular_) kte::detail::raise<singular_mass_matrix>(what_);
    kte::detail::raise<bad_argument>(what_);
  }

 private:
  static constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();
  std::mutex guard_;
  std::size_t state_ = none;
  bool singular_ = false;
  std::string what_;
};

// One copy of the code for all states, because compilers could round one state differently from another.
#if defined(__GNUC__) && !defined(__clang__)
#  define KTE_ONE_COPY noinline, noclone
#else
#  define KTE_ONE_COPY noinline
#endif
#if defined(KTE_NO_FORCED_INLINE)
#  define KTE_FLATTEN
#else
#  define KTE_FLATTEN , flatten
#endif

/// `Function` of a static chain, with In numbers per state of each input, and Out numbers per state of the result.
template <class Function, class Chain, class P, std::size_t Out, std::size_t... In>
class job {
  using T = typename P::value_type;
  static constexpr std::size_t w = P::lanes;
  using inputs = std::array<const T*, sizeof...(In)>;

 public:
  job(const Chain& chain, std::size_t count, T* out, const inputs& in)
      : chain_(chain), count_(count), out_(out), in_(in) {}

  /// The number of tasks, of a few microseconds each.
  std::size_t tasks() const { return (count_ + chunk - 1) / chunk; }
  void operator()(std::size_t task) {
    std::size_t first = task * chunk;
    const std::size_t last = (std::min)(first + chunk, count_);
    while (first + w <= last) {
      std::size_t done = 0;
      try {
        packs(chain_, from(first), out_ + first * Out, (last - first) / w, done);
      } catch (const error&) {
        states(first + done * w, w);
        ++done;
      }
      first += done * w;
    }
    if (first < last) states(first, last - first);
  }
  void raise() const { failure_.raise(); }

 private:
  static constexpr std::size_t chunk = 64 * w;

  inputs from(std::size_t first) const { return from(first, std::index_sequence_for<counted<In>...>{}); }
  template <std::size_t... I>
  inputs from(std::size_t first, std::index_sequence<I...>) const {
    return {in_[I] + first * In...};
  }
  /// The chain is copied, so that compilers know that nothing changes it, and prepare its parameters once instead of
  /// for each pack.
  __attribute__((KTE_ONE_COPY KTE_FLATTEN)) static void packs(const Chain& shared_chain, const inputs& in, T* out,
                                                              std::size_t count, std::size_t& done) {
    const Chain chain = shared_chain;
    for (; done < count; ++done) pack_of_states(chain, in, done * w, out, std::index_sequence_for<counted<In>...>{});
  }
  template <std::size_t... I>
  KTE_INLINE static void pack_of_states(const Chain& chain, const inputs& in, std::size_t first, T* out,
                                        std::index_sequence<I...>) {
    std::tuple<std::array<P, In>...> x;
    (gather<In>(in[I] + first * In, std::get<I>(x).data()), ...);
    scatter<Out>(Function{}(chain, std::get<I>(x)...).data(), out + first * Out);
  }

  /// Evaluates up to w states, repeating the last. If they have no result together, evaluates each separately.
  [[gnu::cold, gnu::noinline]] void states(std::size_t first, std::size_t count) {
    std::array<T, w * Out> out;
    std::tuple<std::array<T, w * In>...> in;
    try {
      padded(first, count, in, out, std::index_sequence_for<counted<In>...>{});
    } catch (const error& e) {
      if (count > 1) {
        for (std::size_t k = 0; k < count; ++k) states(first + k, 1);
        return;
      }
      failure_.at(first, e);
      out.fill(std::numeric_limits<T>::quiet_NaN());
    }
    std::copy_n(out.begin(), count * Out, out_ + first * Out);
  }
  template <class Buffers, std::size_t... I>
  void padded(std::size_t first, std::size_t count, Buffers& in, std::array<T, w * Out>& out,
              std::index_sequence<I...>) const {
    for (std::size_t k = 0; k < w; ++k)
      (std::copy_n(in_[I] + (first + (std::min)(k, count - 1)) * In, In, std::get<I>(in).begin() + k * In), ...);
    std::size_t done = 0;
    packs(chain_, {std::get<I>(in).data()...}, out.data(), 1, done);
  }

  template <std::size_t>
  struct counted {};
  const Chain& chain_;
  std::size_t count_;
  T* out_;
  inputs in_;
  failure failure_;
};
#undef KTE_ONE_COPY
#undef KTE_FLATTEN

}  // namespace kte::batch::detail
