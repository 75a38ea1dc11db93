#pragma once

#include <kte/contract/coordinate_follower.hpp>
#include <kte/kernels/dyad.hpp>
#include <kte/kernels/implicit_function.hpp>
#include <kte/static_chain/static_chain.hpp>

namespace kte {

namespace core {

/// Number W of M coordinates y that follow N others by F(q, y) = 0 (kernels/implicit_function.hpp). Newton's method
/// starts from
///
///   y_0 = guess + z,   z' = y'          (1)
///
/// with M internal states z, which the first of the M elements keeps: so the start is as close to y as an integrator
/// has them, on both sides of a crossing of branches, and a rejected step is forgotten with its state.
template <class Law, std::size_t N, std::size_t M, std::size_t W>
struct implicit_follower {
  static constexpr type_name type{"implicit_follower", kind::gen};
  static constexpr bool holds_code = true, may_have_no_value = true;
  /// `switched` gives the z of the present position, from which a motion starts.
  static constexpr bool starts_in_place = W == 0;
  static constexpr std::array<port, N + M + 1> ports = [] {
    constexpr std::string_view bases[]{"base1", "base2", "base3", "base4", "base5", "base6"};
    constexpr std::string_view starts[]{"start1", "start2", "start3", "start4", "start5", "start6"};
    std::array<port, N + M + 1> p{};
    for (std::size_t i = 0; i < N; ++i) p[i] = {kind::gen, access::in, bases[i]};
    for (std::size_t k = 0; k < M; ++k) p[N + k] = {kind::internal, W == 0 ? access::keep : access::in, starts[k]};
    p[N + M] = {kind::gen, access::out, "end"};
    return p;
  }();

  Law law;
  std::array<double, M> guess;

  constexpr implicit_follower(const Law& f, const std::array<double, M>& g) : law(f), guess(g) {}

  template <class... X>
  constexpr auto doMotion(const X&... x) const {
    const auto things = std::tie(x...);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      using S = typename scalar<I...>::template of<decltype(things)>;
      using first = std::tuple_element_t<0, std::tuple<X...>>;
      const auto& get = things;
      if constexpr (detail::has_skip<std::remove_cvref_t<decltype(std::declval<first>().q_dot)>>) {
        return coordinate{values<S>({as<S>(std::get<I>(get).q)...}, get)[W], skip{}, skip{}, skip{}, skip{}};
      } else if constexpr (detail::has_skip<std::remove_cvref_t<decltype(std::declval<first>().q_ddot)>>) {
        const auto y = values<dual<S, 1>>(moving<S>(std::get<I>(get)...), get)[W];
        return coordinate{y.value, y.derivative[0], skip{}, skip{}, skip{}};
      } else {  // along the motion, twice
        using twice = dual<dual<S, 1>, 1>;
        const auto y = values<twice>({along(along(as<S>(std::get<I>(get).q), as<S>(std::get<I>(get).q_dot)),
                                            along(as<S>(std::get<I>(get).q_dot), as<S>(std::get<I>(get).q_ddot)))...},
                                     get)[W];
        return coordinate{y.value.value, y.value.derivative[0], y.derivative[0].derivative[0], skip{}, skip{}};
      }
    }
    (std::make_index_sequence<N>{});
  }
  template <class... X>
  constexpr auto doForce(const X&... x) const {
    const auto things = std::tie(x...);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      using S = typename scalar<I...>::template of<decltype(things)>;
      using number = dual<S, static_cast<int>(N)>;
      std::array<number, N> q{number(as<S>(std::get<I>(things).q))...};
      for (std::size_t i = 0; i < N; ++i) q[i].derivative[i] = S(1);
      const number y = values<number>(q, things)[W];
      return make_loads(y.derivative[I] * std::get<N + M>(things)...);
    }
    (std::make_index_sequence<N>{});
  }
  /// y' of all.
  template <class... X>
  constexpr auto z_dot(const X&... x) const requires(W == 0) {
    const auto things = std::tie(x...);
    return [&]<std::size_t... I, std::size_t... K>(std::index_sequence<I...>, std::index_sequence<K...>) {
      using S = typename scalar<I...>::template of<decltype(things)>;
      const auto y = values<dual<S, 1>>(moving<S>(std::get<I>(things)...), things);
      return make_rates(y[K].derivative[0]...);
    }
    (std::make_index_sequence<N>{}, std::make_index_sequence<M>{});
  }
  template <class... X>
  constexpr auto switched(const X&... x) const requires(W == 0) {
    const auto things = std::tie(x...);
    return [&]<std::size_t... I, std::size_t... K>(std::index_sequence<I...>, std::index_sequence<K...>) {
      using S = typename scalar<I...>::template of<decltype(things)>;
      const auto y = values<S>({as<S>(std::get<I>(things).q)...}, things);
      return make_rates(S(y[K] - S(guess[K]))...);
    }
    (std::make_index_sequence<N>{}, std::make_index_sequence<M>{});
  }

  constexpr void check(const parameter_check& where) const {
    for (const double y : guess) where.finite(y, "guess must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}

 private:
  template <std::size_t... I>
  struct scalar {
    template <class Things>
    using of = typename detail::scalar_among<
        std::remove_cvref_t<decltype(std::get<I>(std::declval<const Things&>()).q)>...>::type;
  };
  /// A number and its rate.
  template <class T>
  static constexpr dual<T, 1> along(const T& x, const T& rate) {
    dual<T, 1> n(x);
    n.derivative[0] = rate;
    return n;
  }
  template <class S, class... C>
  static constexpr std::array<dual<S, 1>, N> moving(const C&... c) {
    return {along(as<S>(c.q), as<S>(c.q_dot))...};
  }
  /// y and its derivatives.
  template <class T, class Things>
  constexpr std::array<T, M> values(const std::array<T, N>& q, const Things& things) const {
    using S = typename detail::derivatives_of<T>::plain;
    std::array<S, M> start;
    bool starts_near = false;
    const auto take = [&](std::size_t k, const auto& z) {
      const S z_k = as<S>(detail::derivatives_of<std::remove_cvref_t<decltype(z)>>::value(z));
      start[k] = S(guess[k]) + z_k;
      starts_near |= any(z_k != S(0));
    };
    [&]<std::size_t... K>(std::index_sequence<K...>) {
      const int done[]{(take(K, std::get<N + K>(things)), 0)...};
      (void)done;
    }
    (std::make_index_sequence<M>{});
    return detail::implicit_value<T>(law, q, start, starts_near,
                                     [](detail::no_solution_of why, const auto& at) { refuse(why, at); });
  }
  template <class S>
  [[noreturn, gnu::cold]] static void refuse(detail::no_solution_of why, const std::array<S, N>& q) {
    std::string at;
    for (const S& x : q) at += (at.empty() ? "" : ", ") + detail::number(static_cast<double>(x));
    const std::string name = "kte: implicit_follower_gen";
    if (why == detail::no_solution_of::undetermined)
      detail::raise<dead_point>(
          name + ": dead point at " + at +
          ": its function does not determine how the coordinate moves; let another coordinate lead");
    if (why == detail::no_solution_of::ambiguous)
      detail::raise<bad_argument>(
          name + ": two solutions near " + at +
          " are too close to each other to tell which is meant: take shorter steps, or start elsewhere");
    detail::raise<bad_argument>(name + " has no solution at " + at + ", beyond a dead point or too far from the guess");
  }
};

}  // namespace core

namespace detail {
template <class Law, std::size_t N, std::size_t M, std::size_t... I, std::size_t... K, class Names>
constexpr auto implicit_followers(const Law& law, const std::array<double, M>& guess, const Names& names,
                                  std::index_sequence<I...>, std::index_sequence<K...>) {
  const auto one = [&]<std::size_t W>(std::integral_constant<std::size_t, W>) {
    return connect(core::implicit_follower<Law, N, M, W>(law, guess), std::get<I>(names)...,
                   std::get<N + M + K>(names)..., std::get<N + W>(names));
  };
  if constexpr (M == 1) {
    return one(std::integral_constant<std::size_t, 0>{});
  } else if constexpr ((is_element<decltype(one(std::integral_constant<std::size_t, K>{}))> && ...)) {
    return chain(one(std::integral_constant<std::size_t, K>{})...);
  } else {
    return together(one(std::integral_constant<std::size_t, K>{})...);
  }
}
}  // namespace detail

/// Coordinates y that follow one to six others by equations F(q, y) = 0, as many as there are y; m or rad:
///
///   kte::implicit_follower_gen([](const auto& q, const auto& y) { return ...; }, guess, crank, rocker, start)
///   kte::implicit_follower_gen([](const auto& q, const auto& y1, const auto& y2) { return kte::make_rows(f1, f2); },
///                              std::array{guess1, guess2}, crank, coupler, rocker, start1, start2)
///
/// The function must accept numbers of any type, which carry derivatives. After it and the guess of y come the names of
/// the coordinates q, of y, and of internal states, one for each y. Newton's method starts from the guess at the start
/// of a motion, then from y as integrated from its rate: y stays on its branch, also where branches cross, as those of
/// a parallelogram. Functions without a state start from the guess.
///
/// Throws `dead_point` where the rates of y are not determined, `bad_argument` where there is no y, and where two
/// branches are too near to tell: integrators then try shorter steps. A chain with it cannot be saved.
template <class Law, std::size_t M, class... Names>
[[nodiscard]] constexpr auto implicit_follower_gen(const Law& law, const std::array<double, M>& guess,
                                                   const Names&... coordinates_ends_starts) {
  constexpr std::size_t count = sizeof...(Names);
  static_assert(M >= 1 && M <= 6 && count > 2 * M && count <= 2 * M + 6,
                "kte: implicit_follower_gen takes a function, guesses of one to six coordinates, the names of one to "
                "six coordinates that they follow, their own, and as many of internal states");
  constexpr std::size_t n = count > 2 * M ? count - 2 * M : 1;
  return detail::implicit_followers<Law, n, M>(law, guess, std::tie(coordinates_ends_starts...),
                                               std::make_index_sequence<n>{}, std::make_index_sequence<M>{});
}
template <class Law, class... Names>
[[nodiscard]] constexpr auto implicit_follower_gen(const Law& law, double guess,
                                                   const Names&... coordinates_end_start) {
  return implicit_follower_gen(law, std::array{guess}, coordinates_end_start...);
}

}  // namespace kte
