#pragma once

#include <kte/detail/inline.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#if __has_include(<xsimd/xsimd.hpp>) && !defined(KTE_NO_XSIMD)
#  include <xsimd/xsimd.hpp>
#endif

/// What a pack is made of: registers of the CPU, by xsimd; or plain numbers, where xsimd or a register short enough is
/// missing. Both have the same operators, and the functions below.
namespace kte::detail {

/// Instead of an architecture of xsimd: one number is one register.
struct plain {};

template <class T>
using bits_of = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;

template <class T, class Arch>
struct pack_register {
  using type = T;
  using bits = bits_of<T>;
  using mask = bool;
  static constexpr std::size_t lanes = 1;
  KTE_INLINE static T load(const T* p) { return *p; }
  KTE_INLINE static void store(T* p, T x) { *p = x; }
};

KTE_INLINE bool all_in(bool x) { return x; }
KTE_INLINE bool negated(bool x) { return !x; }
KTE_INLINE bool both(bool a, bool b) { return a && b; }
KTE_INLINE bool either(bool a, bool b) { return a || b; }
template <class T>
KTE_INLINE T chosen(bool condition, T a, T b) {
  return condition ? a : b;
}
template <class T>
requires std::is_arithmetic_v<T> KTE_INLINE T root(T x) { return std::sqrt(x); }
template <class T>
requires std::is_arithmetic_v<T> KTE_INLINE T magnitude(T x) { return std::fabs(x); }
template <class T>
requires std::is_arithmetic_v<T> KTE_INLINE T shifted_left(T x, int by) { return x << by; }

#if __has_include(<xsimd/xsimd.hpp>) && !defined(KTE_NO_XSIMD)

template <class T, class Arch>
requires(!std::is_same_v<Arch, plain>) struct pack_register<T, Arch> {
  using type = xsimd::batch<T, Arch>;
  using bits = xsimd::batch<bits_of<T>, Arch>;
  using mask = xsimd::batch_bool<T, Arch>;
  static constexpr std::size_t lanes = type::size;
  KTE_INLINE static type load(const T* p) { return type::load_unaligned(p); }
  KTE_INLINE static void store(T* p, const type& x) { x.store_unaligned(p); }
};

template <class T, class A>
KTE_INLINE xsimd::batch_bool<T, A> both(const xsimd::batch_bool<T, A>& a, const xsimd::batch_bool<T, A>& b) {
  return a & b;
}
template <class T, class A>
KTE_INLINE xsimd::batch_bool<T, A> either(const xsimd::batch_bool<T, A>& a, const xsimd::batch_bool<T, A>& b) {
  return a | b;
}
template <class T, class A>
KTE_INLINE bool all_in(const xsimd::batch_bool<T, A>& x) {
  return xsimd::all(x);
}
template <class T, class A>
KTE_INLINE xsimd::batch_bool<T, A> negated(const xsimd::batch_bool<T, A>& x) {
  return !x;
}
template <class T, class A>
KTE_INLINE xsimd::batch<T, A> chosen(const xsimd::batch_bool<T, A>& condition, const xsimd::batch<T, A>& a,
                                     const xsimd::batch<T, A>& b) {
  return xsimd::select(condition, a, b);
}
#  if defined(__GNUC__) && !defined(__clang__)
#    pragma GCC diagnostic push
#    pragma GCC diagnostic ignored "-Wuninitialized"  // about g++'s own headers, which mean it
#    pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#  endif
template <class T, class A>
KTE_INLINE xsimd::batch<T, A> root(const xsimd::batch<T, A>& x) {
  return xsimd::sqrt(x);
}
template <class T, class A>
KTE_INLINE xsimd::batch<T, A> magnitude(const xsimd::batch<T, A>& x) {
  return xsimd::abs(x);
}
template <class T, class A>
KTE_INLINE xsimd::batch<T, A> shifted_left(const xsimd::batch<T, A>& x, int by) {
  return x << by;
}
#  if defined(__GNUC__) && !defined(__clang__)
#    pragma GCC diagnostic pop
#  endif

/// The best of the architectures that the compiler may use (xsimd lists them best first) with a register of T of at
/// most N lanes.
template <class T, int N, class Archs>
struct best_for : std::type_identity<plain> {};
template <class T, int N, class A, class... B>
struct best_for<T, N, xsimd::arch_list<A, B...>>
    : std::conditional_t<(xsimd::batch<T, A>::size <= std::size_t{N}), std::type_identity<A>,
                         best_for<T, N, xsimd::arch_list<B...>>> {};
template <class T, int N>
using pack_arch = typename best_for<T, N, xsimd::supported_architectures>::type;

#else

template <class T, int N>
using pack_arch = plain;

#endif

/// Lanes of the widest register.
template <class T>
inline constexpr int widest_pack = static_cast<int>(pack_register<T, pack_arch<T, 1024>>::lanes);

}  // namespace kte::detail
