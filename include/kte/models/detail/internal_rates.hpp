#pragma once

#include <kte/contract/passes.hpp>
#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/given.hpp>

/// Internal states of elements in fused evaluations.
namespace kte::detail {

/// A base at rest, with signals from memory: inputs from u.
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

/// The rates of internal states when the whole chain moves, with positions.
template <class Base>
struct base_in_motion : Base {
  template <kind, int>
  KTE_INLINE static constexpr auto at() {
    return motion{zero3{}, no_rotation{}, zero3{}, zero3{}, zero3{}, zero3{}};
  }
};

/// Whether element I reads external items only: degrees of freedom and signals.
template <class Chain, std::size_t I>
inline constexpr bool sees_coordinates_only = [] {
  using core = typename Chain::template core_type<I>;
  using wiring = typename Chain::wiring;
  for (std::size_t p = 0; p < input_count<core>; ++p) {
    const kind k = wiring::what(I, p);
    if (k != kind::internal && (is_frame(k) || wiring::writer(k, wiring::slot(I, p)) >= 0)) return false;
  }
  return true;
}();

/// The items that elements read: degrees of freedom and external signals.
template <class Chain, class Given>
class outside {
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;

 public:
  outside(const Chain&, const Given& g) : given_(g) {}
  template <std::size_t I, std::size_t P>
  auto seen() const {
    return types::template given<wiring::what(I, P), wiring::slot(I, P)>(given_);
  }

 private:
  const Given& given_;
};
/// The items that elements read when a chain moves. There are no accelerations.
template <class Chain, class Given>
struct inside : unrolled_motion<Chain, Given> {
  using unrolled_motion<Chain, Given>::unrolled_motion;
  using typename unrolled_motion<Chain, Given>::types;
  template <std::size_t I, std::size_t P>
  decltype(auto) seen() const {
    return this->template get<types::template what<I, P>, Chain::wiring::slot(I, P), types::template shown<I, P>>();
  }
};

/// Computes z_dot[i] of every internal state i.
template <class Chain, class Seen, class S>
class internal_rates_of {
  using wiring = typename Chain::wiring;

 public:
  internal_rates_of(const Chain& c, const Seen& seen, S* z_dot) : chain_(c), seen_(seen), z_dot_(z_dot) {}
  void compute() const {
    unroll<Chain::size>([this]<std::size_t I>() { this->template one<I>(); });
  }

 private:
  template <std::size_t I>
  void one() const {
    using core = typename Chain::template core_type<I>;
    if constexpr (kept_count < core >> 0) compute<I>(std::make_index_sequence<input_count<core>>{});
  }
  template <std::size_t I, std::size_t... P>
  void compute(std::index_sequence<P...>) const {
    using core = typename Chain::template core_type<I>;
    const auto rates = chain_.template core<I>().z_dot(seen_.template seen<I, P>()...);
    unroll<kept_count<core>>(
        [&]<std::size_t N>() { z_dot_[wiring::slot(I, kept_port<core, N>)] = as<S>(rate_of_kept<N>(rates)); });
  }

  const Chain& chain_;
  const Seen& seen_;
  S* z_dot_;
};
/// Whether all elements with internal states read external items only; whether a signal depends on accelerations.
template <class Chain, class Elements = std::make_index_sequence<Chain::size>>
struct kept_states_of;
template <class Chain, std::size_t... I>
struct kept_states_of<Chain, std::index_sequence<I...>> {
  template <std::size_t J>
  using core = typename Chain::template core_type<J>;
  static constexpr bool outside_only = ((kept_count<core<I>> == 0 || sees_coordinates_only<Chain, I>)&&...);
  static constexpr bool of_accelerations = (reads_accelerations<core<I>> || ...);
};

template <class S, class Chain, class At, class Base>
void internal_rates(const Chain& c, const At& at, const S* v, const Base& base, S* z_dot) {
  using numbers = each<S, const S*>;
  const auto put = [&](const auto& seen) {
    internal_rates_of<Chain, std::remove_cvref_t<decltype(seen)>, S>(c, seen, z_dot).compute();
  };
  if constexpr (kept_states_of<Chain>::outside_only) {
    using given_type = given<At, numbers, same<zero_t>, Base>;
    const given_type g{at, numbers{v}, {}, base};
    put(outside<Chain, given_type>(c, g));
  } else {
    static_assert(!kept_states_of<Chain>::of_accelerations,
                  "kte: rates of internal states that depend on frames or signals are not known in a static chain that "
                  "measures accelerations");
    using given_type = given<At, numbers, same<zero_t>, base_in_motion<Base>, true>;
    const given_type g{at, numbers{v}, {}, base_in_motion<Base>{base}};
    put(inside<Chain, given_type>(c, g));
  }
}

}  // namespace kte::detail
