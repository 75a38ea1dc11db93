#pragma once

#include <kte/math/out_of_line.hpp>

namespace kte::detail {

/// Numbers with derivatives, of other such numbers or of plain ones: `order` times. `with<L>`: with plain numbers L.
template <class T>
struct derivatives_of {
  static constexpr int order = 0;
  using plain = T;
  template <class L>
  using with = L;
  static constexpr const T& value(const T& x) { return x; }
  template <class L>
  static constexpr L to(const T& x) {
    return static_cast<L>(x);
  }
  template <class L>
  static constexpr T from(const L& x) {
    return static_cast<T>(x);
  }
};
template <class T, int N>
struct derivatives_of<dual<T, N>> {
  using inner = derivatives_of<T>;
  static constexpr int order = 1 + inner::order;
  using plain = typename inner::plain;
  template <class L>
  using with = dual<typename inner::template with<L>, N>;
  static constexpr const plain& value(const dual<T, N>& x) { return inner::value(x.value); }
  template <class L>
  static constexpr with<L> to(const dual<T, N>& x) {
    with<L> y(inner::template to<L>(x.value));
    for (std::size_t i = 0; i < N; ++i) y.derivative[i] = inner::template to<L>(x.derivative[i]);
    return y;
  }
  template <class X>
  static constexpr dual<T, N> from(const X& x) {
    dual<T, N> y(inner::from(x.value));
    for (std::size_t i = 0; i < N; ++i) y.derivative[i] = inner::from(x.derivative[i]);
    return y;
  }
};
template <class D>
struct derivatives_of<out_of_line<D>> : derivatives_of<D> {
  static constexpr const auto& value(const out_of_line<D>& x) { return derivatives_of<D>::value(x.number); }
  template <class L>
  static constexpr auto to(const out_of_line<D>& x) {
    return derivatives_of<D>::template to<L>(x.number);
  }
  template <class X>
  static constexpr out_of_line<D> from(const X& x) {
    return derivatives_of<D>::from(x);
  }
};

}  // namespace kte::detail
