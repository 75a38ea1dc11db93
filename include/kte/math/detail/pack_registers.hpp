#pragma once

#include <kte/detail/inline.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#if __has_include(<xsimd/xsimd.hpp>) && !defined(KTE_NO_XSIMD)
#  include <xsimd/xsimd.hpp>
#endif

/// The registers of a pack: compiler vectors with the size of a CPU register, or plain numbers if xsimd or a register
/// of suitable size is missing. Both have the same operators and the functions below.
///
/// Everything is built in or inlined immediately. A function that g++ inlines later is first a call that may keep its
/// addresses: with the operators of xsimd and std, pointer analysis took five minutes for forward dynamics of seven
/// joints.
namespace kte::detail {

/// Instead of an architecture of xsimd: one number is one register.
struct plain_registers {};

template <class T>
using bits_of = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;

// clang fuses products and sums within an expression, and across expressions only on request; g++ always does.
#if defined(__clang__)
#  define KTE_FUSED _Pragma("clang fp contract(fast)")
#else
#  define KTE_FUSED
#endif
struct plus {
  template <class R>
  KTE_INLINE R operator()(const R& a, const R& b) const {
    KTE_FUSED return a + b;
  }
};
struct minus {
  template <class R>
  KTE_INLINE R operator()(const R& a, const R& b) const {
    KTE_FUSED return a - b;
  }
};
struct times {
  template <class R>
  KTE_INLINE R operator()(const R& a, const R& b) const {
    KTE_FUSED return a * b;
  }
};
struct over {
  template <class R>
  KTE_INLINE R operator()(const R& a, const R& b) const {
    return a / b;
  }
};
struct negative {
  template <class R>
  KTE_INLINE R operator()(const R& a) const {
    return -a;
  }
};
#undef KTE_FUSED

/// Functions without an operator.
template <class T, class Arch>
struct pack_register {
  using type = T;
  using bits = bits_of<T>;
  using mask = bool;
  static constexpr std::size_t lanes = 1;
  KTE_INLINE static T of(T x) { return x; }
  KTE_INLINE static T root(T x) { return std::sqrt(x); }
  KTE_INLINE static T magnitude(T x) { return std::fabs(x); }
  KTE_INLINE static mask less(T a, T b) { return a < b; }
  KTE_INLINE static mask less_equal(T a, T b) { return a <= b; }
  KTE_INLINE static mask equal(T a, T b) { return a == b; }
  KTE_INLINE static mask both(mask a, mask b) { return a && b; }
  KTE_INLINE static mask either(mask a, mask b) { return a || b; }
  KTE_INLINE static mask negated(mask a) { return !a; }
  KTE_INLINE static bool in_all(mask a) { return a; }
  KTE_INLINE static T chosen(mask condition, T a, T b) { return condition ? a : b; }
};

#if __has_include(<xsimd/xsimd.hpp>) && !defined(KTE_NO_XSIMD)

/// Arithmetic by compiler operators; comparisons and rare functions by xsimd.
template <class T, class Arch>
requires(!std::is_same_v<Arch, plain_registers>) struct pack_register<T, Arch> {
  using batch = xsimd::batch<T, Arch>;
  using mask = xsimd::batch_bool<T, Arch>;
  static constexpr std::size_t lanes = batch::size;
  typedef T type __attribute__((vector_size(sizeof(T) * lanes)));
  typedef bits_of<T> bits __attribute__((vector_size(sizeof(T) * lanes)));
  KTE_INLINE static type of(T x) { return of(x, std::make_index_sequence<lanes>{}); }
#  if defined(__GNUC__) && !defined(__clang__)
#    pragma GCC diagnostic push
#    pragma GCC diagnostic ignored "-Wuninitialized"  // about g++'s own headers, which mean it
#    pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#  endif
  KTE_INLINE static type root(const type& x) { return xsimd::sqrt(batch(x)).data; }
  KTE_INLINE static type magnitude(const type& x) { return xsimd::abs(batch(x)).data; }
#  if defined(__GNUC__) && !defined(__clang__)
#    pragma GCC diagnostic pop
#  endif
  KTE_INLINE static mask less(const type& a, const type& b) { return batch(a) < batch(b); }
  KTE_INLINE static mask less_equal(const type& a, const type& b) { return batch(a) <= batch(b); }
  KTE_INLINE static mask equal(const type& a, const type& b) { return batch(a) == batch(b); }
  KTE_INLINE static mask both(const mask& a, const mask& b) { return a & b; }
  KTE_INLINE static mask either(const mask& a, const mask& b) { return a | b; }
  KTE_INLINE static mask negated(const mask& a) { return !a; }
  KTE_INLINE static bool in_all(const mask& a) { return xsimd::all(a); }
  KTE_INLINE static type chosen(const mask& condition, const type& a, const type& b) {
    return xsimd::select(condition, batch(a), batch(b)).data;
  }

 private:
  template <std::size_t... I>
  KTE_INLINE static type of(T x, std::index_sequence<I...>) {
    return type{(void(I), x)...};
  }
};

/// The best of the architectures that the compiler may use (xsimd lists them best first) with a register of T of at
/// most N lanes.
template <class T, int N, class Archs>
struct best_for : std::type_identity<plain_registers> {};
template <class T, int N, class A, class... B>
struct best_for<T, N, xsimd::arch_list<A, B...>>
    : std::conditional_t<(xsimd::batch<T, A>::size <= std::size_t{N}), std::type_identity<A>,
                         best_for<T, N, xsimd::arch_list<B...>>> {};
template <class T, int N>
using pack_arch = typename best_for<T, N, xsimd::supported_architectures>::type;

#else

template <class T, int N>
using pack_arch = plain_registers;

#endif

/// Lanes of the widest register.
template <class T>
inline constexpr int widest_pack = static_cast<int>(pack_register<T, pack_arch<T, 1024>>::lanes);

}  // namespace kte::detail
