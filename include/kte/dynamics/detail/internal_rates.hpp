#pragma once

#include <kte/contract/passes.hpp>
#include <kte/dynamics/detail/given.hpp>

/// Internal states of elements in fused evaluations.
namespace kte::detail {

/// A base at rest, and signals from memory: inputs as they stand in u.
template <class Wiring, class Base, class S>
struct base_with_signals : Base {
  S time;
  const S* inputs;
  const S* internals;
  template <int I>
  KTE_INLINE S input() const {
    constexpr int place = Wiring::input_place(kind::input, I);
    if constexpr (place < 0) {
      return time;
    } else {
      return inputs[place];
    }
  }
  template <int I>
  KTE_INLINE vec3<S> vector() const {
    constexpr int place = Wiring::input_place(kind::vector, I);
    return {inputs[place], inputs[place + 1], inputs[place + 2]};
  }
  template <int I>
  KTE_INLINE S internal() const {
    return internals[I];
  }
};
template <class Wiring, class Base, class S>
KTE_INLINE auto with_signals(const Base& base, const S& time, const S* inputs, const S* internals) {
  return base_with_signals<Wiring, Base, S>{base, time, inputs, internals};
}

/// Whether element I sees only what comes from outside: degrees of freedom and signals.
template <class Chain, std::size_t I>
inline constexpr bool sees_coordinates_only = [] {
  using core = typename Chain::template core_type<I>;
  using wiring = typename Chain::wiring;
  for (std::size_t p = 0; p < port_count<core>; ++p) {
    const kind k = wiring::what(I, p);
    if (!is_signal(k) && (is_frame(k) || wiring::writer(k, wiring::slot(I, p)) >= 0)) return false;
  }
  return true;
}();

/// z_dot[i] of every internal state i, at q and v.
template <class S, class Chain, class At, class Base>
class internal_rates_of {
  using wiring = typename Chain::wiring;
  using given_type = given<At, each<S, const S*>, same<zero_t>, Base>;
  using types = local_types<Chain, given_type>;

 public:
  internal_rates_of(const Chain& c, const given_type& g, S* z_dot) : chain_(c), given_(g), z_dot_(z_dot) {}
  void compute() const { all(std::make_index_sequence<Chain::size>{}); }

 private:
  template <std::size_t... I>
  void all(std::index_sequence<I...>) const {
    const int done[]{(one<I>(), 0)..., 0};
    (void)done;
  }
  template <std::size_t I>
  void one() const {
    using core = typename Chain::template core_type<I>;
    if constexpr (kept_count < core >> 0) {
      static_assert(sees_coordinates_only<Chain, I>,
                    "kte: an element with an internal state must be on degrees of freedom for this; others move by "
                    "doMotion on a state of the chain");
      compute<I>(std::make_index_sequence<input_count<core>>{});
    }
  }
  template <std::size_t I, std::size_t... P>
  void compute(std::index_sequence<P...>) const {
    using core = typename Chain::template core_type<I>;
    const auto rates =
        chain_.template core<I>().z_dot(types::template given<wiring::what(I, P), wiring::slot(I, P)>(given_)...);
    [&]<std::size_t... N>(std::index_sequence<N...>) {
      const int done[]{(z_dot_[wiring::slot(I, kept_port<core, N>)] = as<S>(rate_of_kept<N>(rates)), 0)...};
      (void)done;
    }
    (std::make_index_sequence<kept_count<core>>{});
  }

  const Chain& chain_;
  const given_type& given_;
  S* z_dot_;
};
template <class S, class Chain, class At, class Base>
void internal_rates(const Chain& c, const At& at, const S* v, const Base& base, S* z_dot) {
  const given<At, each<S, const S*>, same<zero_t>, Base> g{at, each<S, const S*>{v}, {}, base};
  internal_rates_of<S, Chain, At, Base>(c, g, z_dot).compute();
}

}  // namespace kte::detail
