#pragma once

#include <kte/math/detail/pack_registers.hpp>

#include <cstring>
#include <utility>

/// N numbers with common arithmetic: a scalar type for the templates of this library. A static chain evaluated on packs
/// is evaluated on N states in about the time of one.
namespace kte {

/// The result of a comparison of packs: one truth value per element.
template <class T, int N, class Arch = detail::pack_arch<T, N>>
class pack_mask {
  using reg = detail::pack_register<T, Arch>;
  static constexpr std::size_t count = std::size_t{N} / reg::lanes;
  using registers = std::make_index_sequence<count>;

 public:
  pack_mask() = default;

  KTE_INLINE friend pack_mask operator&(const pack_mask& a, const pack_mask& b) { return both(a, b, registers{}); }
  KTE_INLINE friend pack_mask operator|(const pack_mask& a, const pack_mask& b) { return either(a, b, registers{}); }
  KTE_INLINE friend pack_mask operator!(const pack_mask& a) { return none(a, registers{}); }
  KTE_INLINE pack_mask& operator&=(const pack_mask& b) { return *this = *this & b; }
  KTE_INLINE pack_mask& operator|=(const pack_mask& b) { return *this = *this | b; }

  /// Whether the condition holds in all elements; `any`: in at least one.
  KTE_INLINE friend bool all(const pack_mask& a) { return all_of(a, registers{}); }
  KTE_INLINE friend bool any(const pack_mask& a) { return !all_of(!a, registers{}); }

 private:
  template <class, int, class>
  friend class pack;
  template <std::size_t... I>
  KTE_INLINE static pack_mask both(const pack_mask& a, const pack_mask& b, std::index_sequence<I...>) {
    pack_mask r;
    ((r.m_[I] = reg::both(a.m_[I], b.m_[I])), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE static pack_mask either(const pack_mask& a, const pack_mask& b, std::index_sequence<I...>) {
    pack_mask r;
    ((r.m_[I] = reg::either(a.m_[I], b.m_[I])), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE static pack_mask none(const pack_mask& a, std::index_sequence<I...>) {
    pack_mask r;
    ((r.m_[I] = reg::negated(a.m_[I])), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE static bool all_of(const pack_mask& a, std::index_sequence<I...>) {
    return (reg::in_all(a.m_[I]) && ...);
  }
  typename reg::mask m_[count];
};

/// N floats or doubles, N a power of two. Any number converts to a pack, so that `2 * x` and `x + 0.5` work; with
/// floats the number is rounded to float. CPU options (`Arch`) are part of the type, so that units compiled with
/// different options can be linked.
template <class T, int N, class Arch = detail::pack_arch<T, N>>
class pack {
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, double>, "kte: packs are of float or double");
  static_assert(N > 0 && (N & (N - 1)) == 0, "kte: a pack has 1, 2, 4, 8 ... lanes");
  using reg = detail::pack_register<T, Arch>;
  static constexpr std::size_t count = std::size_t{N} / reg::lanes;

 public:
  using value_type = T;
  using mask = pack_mask<T, N, Arch>;
  using register_functions = reg;
  using register_type = typename reg::type;
  using register_bits = typename reg::bits;
  using registers = std::make_index_sequence<count>;
  /// The number of elements.
  static constexpr int lanes = N;

  pack() = default;
  /// Copies register by register. As a block of bytes, g++ copies a vector of packs in parts of registers, and later
  /// loads of whole registers stall.
  KTE_INLINE pack(const pack& x) { copy(x, registers{}); }
  KTE_INLINE pack& operator=(const pack& x) {  // NOLINT(bugprone-unhandled-self-assignment)
    copy(x, registers{});
    return *this;
  }
  /// One number in all elements.
  template <class U>
  requires std::is_arithmetic_v<U> KTE_INLINE explicit(false) pack(U x) {  // NOLINT(google-explicit-constructor)
    fill(static_cast<T>(x), registers{});
  }

  /// Loads N contiguous numbers; no alignment is needed.
  KTE_INLINE static pack load(const T* p) { return load(p, registers{}); }
  /// Stores N contiguous numbers; no alignment is needed.
  KTE_INLINE void store(T* p) const { store(p, registers{}); }
  /// One element; slow.
  KTE_INLINE T operator[](std::size_t i) const {
    T x;
    std::memcpy(&x, reinterpret_cast<const char*>(&b_) + i * sizeof(T), sizeof(T));
    return x;
  }
  /// Sets one element; slow.
  KTE_INLINE void set(std::size_t i, T x) { std::memcpy(reinterpret_cast<char*>(&b_) + i * sizeof(T), &x, sizeof(T)); }

  KTE_INLINE friend pack operator+(const pack& a, const pack& b) { return map(detail::plus{}, a, b, registers{}); }
  KTE_INLINE friend pack operator-(const pack& a, const pack& b) { return map(detail::minus{}, a, b, registers{}); }
  KTE_INLINE friend pack operator*(const pack& a, const pack& b) { return map(detail::times{}, a, b, registers{}); }
  KTE_INLINE friend pack operator/(const pack& a, const pack& b) { return map(detail::over{}, a, b, registers{}); }
  KTE_INLINE friend pack operator+(const pack& a) { return a; }
  KTE_INLINE friend pack operator-(const pack& a) { return map(detail::negative{}, a, registers{}); }
  KTE_INLINE pack& operator+=(const pack& b) { return *this = *this + b; }
  KTE_INLINE pack& operator-=(const pack& b) { return *this = *this - b; }
  KTE_INLINE pack& operator*=(const pack& b) { return *this = *this * b; }
  KTE_INLINE pack& operator/=(const pack& b) { return *this = *this / b; }

  KTE_INLINE friend mask operator<(const pack& a, const pack& b) { return less(a, b, registers{}); }
  KTE_INLINE friend mask operator<=(const pack& a, const pack& b) { return less_equal(a, b, registers{}); }
  KTE_INLINE friend mask operator>(const pack& a, const pack& b) { return b < a; }
  KTE_INLINE friend mask operator>=(const pack& a, const pack& b) { return b <= a; }
  KTE_INLINE friend mask operator==(const pack& a, const pack& b) { return equal(a, b, registers{}); }
  KTE_INLINE friend mask operator!=(const pack& a, const pack& b) { return !(a == b); }  // true for NaN, as it should

  /// a in the elements where the condition holds, b in the others.
  KTE_INLINE friend pack select(const mask& condition, const pack& a, const pack& b) {
    return chosen(condition, a, b, registers{});
  }

  /// Register i of registers::size(). `map(f, a)` applies f register by register.
  KTE_INLINE register_type& in_register(std::size_t i) { return b_[i]; }
  KTE_INLINE const register_type& in_register(std::size_t i) const { return b_[i]; }
  /// f(a), register by register.
  template <class F>
  KTE_INLINE static pack map(const F& f, const pack& a) {
    return map(f, a, registers{});
  }

 private:
  template <std::size_t... I>
  KTE_INLINE void copy(const pack& x, std::index_sequence<I...>) {
    ((b_[I] = x.b_[I]), ...);
  }
  template <std::size_t... I>
  KTE_INLINE void fill(T x, std::index_sequence<I...>) {
    ((b_[I] = reg::of(x)), ...);
  }
  template <class F, std::size_t... I>
  KTE_INLINE static pack map(const F& f, const pack& a, std::index_sequence<I...>) {
    pack r;
    ((r.b_[I] = f(a.b_[I])), ...);
    return r;
  }
  template <class F, std::size_t... I>
  KTE_INLINE static pack map(const F& f, const pack& a, const pack& b, std::index_sequence<I...>) {
    pack r;
    ((r.b_[I] = f(a.b_[I], b.b_[I])), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE static mask less(const pack& a, const pack& b, std::index_sequence<I...>) {
    mask r;
    ((r.m_[I] = reg::less(a.b_[I], b.b_[I])), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE static mask less_equal(const pack& a, const pack& b, std::index_sequence<I...>) {
    mask r;
    ((r.m_[I] = reg::less_equal(a.b_[I], b.b_[I])), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE static mask equal(const pack& a, const pack& b, std::index_sequence<I...>) {
    mask r;
    ((r.m_[I] = reg::equal(a.b_[I], b.b_[I])), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE static pack chosen(const mask& m, const pack& a, const pack& b, std::index_sequence<I...>) {
    pack r;
    ((r.b_[I] = reg::chosen(m.m_[I], a.b_[I], b.b_[I])), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE static pack load(const T* p, std::index_sequence<I...>) {
    pack r;
    (std::memcpy(&r.b_[I], p + I * reg::lanes, sizeof(register_type)), ...);
    return r;
  }
  template <std::size_t... I>
  KTE_INLINE void store(T* p, std::index_sequence<I...>) const {
    (std::memcpy(p + I * reg::lanes, &b_[I], sizeof(register_type)), ...);
  }
  register_type b_[count];
};

}  // namespace kte

#include <kte/math/pack_functions.hpp>
