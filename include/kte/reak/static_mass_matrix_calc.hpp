#pragma once

#include <kte/reak/mass_blocks.hpp>
#include <kte/reak/motion_jacobians.hpp>
#include <kte/reak/twist_shaping.hpp>

/// The mass matrix of a static chain by twist shaping: reak/twist_shaping.hpp.
namespace kte {

namespace detail {
/// Elements, or degrees of freedom, of a chain in the order of their kinds.
template <class Wiring>
struct bodies_by_kind {
  static constexpr int order(std::size_t e) { return order_of(Wiring::what(e, 0)); }
};
template <class Wiring>
struct coordinates_by_kind {
  static constexpr int order(std::size_t f) { return order_of(Wiring::table.free[f].what); }
};
template <class By, std::size_t New, std::size_t... Fed>
constexpr auto inserted(std::index_sequence<Fed...>) {
  static_assert(((Fed != New) && ...), "kte: mass_matrix_calc: this mass or coordinate is added twice");
  constexpr auto all = [] {
    std::array<std::size_t, sizeof...(Fed) + 1> a{Fed..., New};
    for (std::size_t i = sizeof...(Fed); i > 0 && By::order(a[i - 1]) > By::order(a[i]); --i) std::swap(a[i - 1], a[i]);
    return a;
  }();
  return [&]<std::size_t... I>(std::index_sequence<I...>) { return std::index_sequence<all[I]...>{}; }
  (std::make_index_sequence<sizeof...(Fed) + 1>{});
}
/// Appends those of 0, 1 ... N - 1 for which Wanted::of<I> is true, in order, to those that have been inserted.
template <class By, class Wanted, std::size_t N, std::size_t I = 0, class Fed>
constexpr auto inserted_all(Fed fed) {
  if constexpr (I == N)
    return fed;
  else if constexpr (Wanted::template of<I>)
    return inserted_all<By, Wanted, N, I + 1>(inserted<By, I>(fed));
  else
    return inserted_all<By, Wanted, N, I + 1>(fed);
}
}  // namespace detail

template <class Gravity, class... E, std::size_t... Body, std::size_t... Coordinate>
class mass_matrix_calc<static_chain<Gravity, E...>, std::index_sequence<Body...>, std::index_sequence<Coordinate...>> {
  using chain_type = static_chain<Gravity, E...>;
  using wiring = typename chain_type::wiring;
  using bodies = std::index_sequence<Body...>;
  using coordinates = std::index_sequence<Coordinate...>;
  template <std::size_t I>
  using core = typename chain_type::template core_type<I>;
  template <std::size_t I>
  using key = detail::key_of<std::tuple_element_t<I, std::tuple<E...>>, 0>;

  template <std::size_t I>
  static constexpr bool massive = [] {
    static_assert(!distributed_mass<core<I>>, "kte: mass_matrix_calc: this element has a distributed mass");
    return detail::has_mass<core<I>, double>;
  }();
  struct any_mass {
    template <std::size_t I>
    static constexpr bool of = massive<I>;
  };
  struct any_freedom {
    template <std::size_t>
    static constexpr bool of = true;
  };
  template <std::size_t I, class Key>
  static constexpr bool is_connected_to = []<class Core, class... Keys>(std::type_identity<element<Core, Keys...>>) {
    return (std::is_same_v<Keys, Key> || ...);
  }(std::type_identity<std::tuple_element_t<I, std::tuple<E...>>>{});
  template <class Key>
  struct mass_on {
    template <std::size_t I>
    static constexpr bool of = [] {
      if constexpr (std::is_same_v<key<I>, Key> || (distributed_mass<core<I>> && is_connected_to<I, Key>))
        return massive<I>;
      else
        return false;
    }();
  };
  using by_body = detail::bodies_by_kind<wiring>;
  using by_coordinate = detail::coordinates_by_kind<wiring>;
  template <std::size_t I>
  static constexpr int rows_of = detail::rows_of_moved(wiring::what(I, 0));

 public:
  static constexpr int rows = (0 + ... + rows_of<Body>);
  static constexpr int size = (0 + ... + nv_of(wiring::template free<Coordinate>.what));
  template <class S>
  using shaping_matrix = Eigen::Matrix<S, rows, size>;
  template <class S>
  using masses_matrix = Eigen::Matrix<S, rows, rows>;
  template <class S>
  using matrix_type = Eigen::Matrix<S, size, size>;

  /// Works with a copy of the chain, its bases at rest.
  explicit constexpr mass_matrix_calc(const chain_type& c) : chain_(c) {}

  template <key_type Key>
  constexpr auto operator<<(inertia_on<Key>) const {
    using more = decltype(detail::inserted_all<by_body, mass_on<Key>, sizeof...(E)>(bodies{}));
    static_assert(more::size() > sizeof...(Body), "kte: mass_matrix_calc: there is no mass on this in this chain");
    return with(more{}, coordinates{});
  }
  template <key_type Key>
  constexpr auto operator<<(moved_by<Key>) const {
    constexpr int slot = wiring::template find<Key>();
    constexpr std::size_t at = [] {
      std::size_t f = 0;
      while (f < wiring::freedoms && !(wiring::table.free[f].what == Key::what && wiring::table.free[f].slot == slot))
        ++f;
      return f;
    }();
    static_assert(at < wiring::freedoms, "kte: mass_matrix_calc: this is not a degree of freedom of this chain");
    return with(bodies{}, detail::inserted<by_coordinate, at>(coordinates{}));
  }
  constexpr auto operator<<(all_inertias_t) const {
    return with(detail::inserted_all<by_body, any_mass, sizeof...(E)>(bodies{}), coordinates{});
  }
  constexpr auto operator<<(all_coordinates_t) const {
    return with(bodies{}, detail::inserted_all<by_coordinate, any_freedom, wiring::freedoms>(coordinates{}));
  }

  /// The indices of the columns in v.
  static constexpr std::array<int, std::size_t{size}> columns() {
    std::array<int, std::size_t{size}> all{};
    std::size_t i = 0;
    [[maybe_unused]] const auto add = [&](const detail::freedom& f) {
      for (int k = 0; k < nv_of(f.what); ++k) all[i++] = f.v + k;
      return 0;
    };
    const int done[]{add(wiring::template free<Coordinate>)..., 0};
    (void)done;
    return all;
  }

  /// T, dT/dt and M_c.
  template <indexable Q, indexable V>
  [[nodiscard]] auto twist_shaping(const Q& q, const V& v) const {
    using namespace detail;
    using S = value_of<Q>;
    check_configuration<chain_type>(q), check_velocities<chain_type>(v);
    const auto moving = shaped(moving_along(chain_, q, v));
    twist_shaping_result<shaping_matrix<S>, masses_matrix<S>> t{{}, {}, masses<S>()};
    for (Eigen::Index i = 0; i < moving.size(); ++i)
      t.value.data()[i] = moving.data()[i].value, t.rate.data()[i] = moving.data()[i].derivative[0];
    return t;
  }
  template <indexable Q>
  [[nodiscard]] auto mass_matrix(const Q& q) const {
    return product(shaped(q), masses<value_of<Q>>());
  }
  /// M and dM/dt.
  template <indexable Q, indexable V>
  [[nodiscard]] auto mass_matrix_and_rate(const Q& q, const V& v) const {
    using matrix = matrix_type<value_of<Q>>;
    const auto t = twist_shaping(q, v);
    const matrix half = t.rate.transpose() * t.masses * t.value;
    return mass_matrix_with_rate<matrix>{product(t.value, t.masses), checked(matrix(half + half.transpose()))};  // (1)
  }

 private:
  template <class B, class C>
  constexpr auto with(B, C) const {
    return kte::mass_matrix_calc<chain_type, B, C>(chain_);
  }
  /// T in any scalar, including dual numbers.
  template <class Q>
  auto shaped(const Q& q) const {
    shaping_matrix<value_of<Q>> t;
    Eigen::Index row = 0;
    const int done[]{(put<Body>(t, row, q), 0)..., 0};
    (void)done;
    return t;
  }
  template <std::size_t I, class T, class Q>
  void put(T& t, Eigen::Index& row, const Q& q) const {
    constexpr auto of = columns();
    constexpr kind k = wiring::what(I, 0);
    const auto rows_from = [&](const auto& j, const auto& some) {
      for (const int r : some) {
        for (std::size_t i = 0; i < of.size(); ++i) t(row, static_cast<Eigen::Index>(i)) = j(r, of[i]);
        ++row;
      }
    };
    if constexpr (k == kind::gen)
      rows_from(detail::coordinate_row<wiring::slot(I, 0)>(chain_, q), std::array{0});
    else
      rows_from(jacobian(chain_, q, key<I>{}), detail::rows_in_space<k>());
  }
  template <class S>
  masses_matrix<S> masses() const {
    masses_matrix<S> m = masses_matrix<S>::Zero();
    Eigen::Index row = 0;
    const int done[]{(put_mass<Body>(m, row), 0)..., 0};
    (void)done;
    return m;
  }
  template <std::size_t I, class S>
  void put_mass(masses_matrix<S>& m, Eigen::Index& row) const {
    constexpr kind k = wiring::what(I, 0);
    const auto of = chain_.template core<I>().template mass<S>();
    if constexpr (k == kind::gen) {
      m(row, row) = as<S>(of);
    } else {
      const auto block = detail::mass_block(as<S>(of.mass), as<S>(of.moment), as<S>(of.inertia));
      constexpr auto some = detail::rows_in_space<k>();
      m.template block<rows_of<I>, rows_of<I>>(row, row) = block(some, some);
    }
    row += rows_of<I>;
  }
  template <class T, class M>
  static auto product(const T& t, const M& masses) {
    return checked(matrix_type<typename T::Scalar>(t.transpose() * masses * t));  // (1)
  }
  template <class Matrix>
  static Matrix checked(Matrix m) {
    detail::check_result(m.data(), static_cast<std::size_t>(m.size()), detail::too_large{"a mass matrix"});
    return m;
  }

  chain_type chain_;
};
template <class Gravity, class... E>
mass_matrix_calc(const static_chain<Gravity, E...>&) -> mass_matrix_calc<static_chain<Gravity, E...>>;

}  // namespace kte
