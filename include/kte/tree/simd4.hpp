#pragma once

#include <kte/detail/inline.hpp>
#include <kte/math/vec.hpp>

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

/// Four numbers with common arithmetic, in one register if the scalar has a register of this width.
namespace kte::tree {

template <class S>
struct four_numbers {
  std::array<S, 4> n;

  KTE_INLINE S& operator[](int i) { return n[static_cast<std::size_t>(i)]; }
  KTE_INLINE const S& operator[](int i) const { return n[static_cast<std::size_t>(i)]; }
  KTE_INLINE four_numbers& operator+=(const four_numbers& b) {
    for (int i = 0; i < 4; ++i) (*this)[i] += b[i];
    return *this;
  }
  KTE_INLINE friend four_numbers operator+(const four_numbers& a, const four_numbers& b) {
    return {{S(a[0] + b[0]), S(a[1] + b[1]), S(a[2] + b[2]), S(a[3] + b[3])}};
  }
  KTE_INLINE friend four_numbers operator-(const four_numbers& a, const four_numbers& b) {
    return {{S(a[0] - b[0]), S(a[1] - b[1]), S(a[2] - b[2]), S(a[3] - b[3])}};
  }
  KTE_INLINE friend four_numbers operator*(const four_numbers& a, const four_numbers& b) {
    return {{S(a[0] * b[0]), S(a[1] * b[1]), S(a[2] * b[2]), S(a[3] * b[3])}};
  }
  KTE_INLINE friend four_numbers operator*(const S& a, const four_numbers& b) {
    return {{S(a * b[0]), S(a * b[1]), S(a * b[2]), S(a * b[3])}};
  }
  KTE_INLINE friend four_numbers operator*(const four_numbers& a, const S& b) { return b * a; }
};
template <class S>
struct simd4_of {
  using type = four_numbers<S>;
};
#if defined(__GNUC__) || defined(__clang__)
template <>
struct simd4_of<double> {
  typedef double type __attribute__((vector_size(32)));
};
template <>
struct simd4_of<float> {
  typedef float type __attribute__((vector_size(16)));
};
#endif
/// It has +, - and * with itself, * with S, and []. Pass it by reference, because not all processors pass it in a
/// register.
template <class S>
using simd4 = typename simd4_of<S>::type;

/// Four vectors side by side, in memory.
template <class S>
struct four_vectors {
  std::array<S, 4> x{}, y{}, z{};

  KTE_INLINE void set(std::size_t i, const vec3<S>& v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  KTE_INLINE vec3<S> get(std::size_t i) const { return {x[i], y[i], z[i]}; }
};
template <class S>
KTE_INLINE void load_simd4(simd4<S>& to, const std::array<S, 4>& from) {
  if constexpr (std::is_same_v<simd4<S>, four_numbers<S>>)
    to.n = from;
  else
    std::memcpy(&to, from.data(), sizeof to);
}
template <class S>
KTE_INLINE void load_simd4(vec3<simd4<S>>& to, const four_vectors<S>& from) {
  load_simd4<S>(to.x, from.x), load_simd4<S>(to.y, from.y), load_simd4<S>(to.z, from.z);
}
/// to += a x b
template <class To, class A, class B>
KTE_INLINE void add_cross(To& to, const A& a, const B& b) {
  to.x += a.y * b.z - a.z * b.y, to.y += a.z * b.x - a.x * b.z, to.z += a.x * b.y - a.y * b.x;
}
/// (x_2, x_2, x_2, x_3)
template <class S>
KTE_INLINE void repeat_third(const simd4<S>& x, simd4<S>& y) {
  if constexpr (std::is_same_v<simd4<S>, four_numbers<S>>)
    y.n = {x[2], x[2], x[2], x[3]};
  else
    y = __builtin_shufflevector(x, x, 2, 2, 2, 3);
}

}  // namespace kte::tree
