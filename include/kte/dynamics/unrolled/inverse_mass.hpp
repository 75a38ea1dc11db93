#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/articulated.hpp>
#include <kte/dynamics/unrolled/unit_forces.hpp>
#include <kte/recursions/inverse_mass.hpp>

namespace kte::detail {

/// The bodies of a chain at rest, without loads.
template <class S, class Chain, class Axes>
struct resting_bodies : typed_bodies<S, Chain, Axes> {
  using typed_bodies<S, Chain, Axes>::typed_bodies;
  template <std::size_t I>
  KTE_INLINE constexpr auto body() const {
    return this->template body_with<I>(this->template own_mass<I>(),
                                       []() KTE_INLINE_LAMBDA { return engine::no_value{}; });
  }
};

/// The inverse of the mass matrix of a static chain (recursions/inverse_mass.hpp). Axes on one path to the base share a
/// register (unit_forces.hpp).
template <class S, class Chain, class Given, class Elements = std::make_index_sequence<Chain::size>>
class inverted_mass;

template <class S, class Chain, class Given, std::size_t... E>
class inverted_mass<S, Chain, Given, std::index_sequence<E...>> : articulated_chain<S, Chain, Given> {
  using base = articulated_chain<S, Chain, Given>;
  using typename base::axes;
  using typename base::types;
  using typename base::vector;
  using typename base::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;

  /// Whether a wrench in numbers S remains in S beyond element I. It does not for parameters of other precision, and
  /// registers hold numbers of one type.
  using bodies_type = resting_bodies<S, base, axes>;
  template <std::size_t I>
  static constexpr bool keeps_numbers() {
    if constexpr (is_transmission<core_t<I>>)
      return is_wrench_of<S, decltype(engine::pulled_back(std::declval<const bodies_type&>().template body<I>(),
                                                          wrench<vec3<S>, vec3<S>>{}))>;
    else
      return true;
  }
  static constexpr std::size_t width = (keeps_numbers<E>() && ...) ? tree::simd_of<S>::count : 1;
  using simd = std::conditional_t<width == 1, S, tree::simd<S>>;
  static constexpr auto forces = side_by_side<width, Chain::dofs>(
      std::array{joint_place_of<Chain, E, axes::template is_free<E>>()..., joint_place{}});

 public:
  using base::base;

  /// Throws `singular_mass_matrix`.
  template <class Matrix>
  KTE_INLINE void invert(Matrix& m) {
    const bodies_type bodies(*this);
    const engine::unrolled<bodies_type> d{bodies};
    engine::articulate_at_rest(d, engine::no_value{}, this->factors_.data(), this->unmoved_);
    each_jointless_mass([this]<int Row>(std::integral_constant<int, Row>, const S& mass)
                            KTE_INLINE_LAMBDA { note(this->unmoved_, Row, all(mass > S(0)), mass); });
    columns(d, m);
    this->check_moved();
  }
  /// As `invert`, after accelerations under forces `tau`, which share the outward recursion.
  template <class Matrix>
  KTE_INLINE void accelerate_and_invert(const vector& tau, vector& a, Matrix& m) {
    this->accelerate(tau, a);
    const bodies_type bodies(*this);
    columns(engine::unrolled<bodies_type>{bodies}, m);
  }

 private:
  template <class Driver, class Matrix>
  KTE_INLINE void columns(const Driver& d, Matrix& m) {
    unroll<int{forces.groups}>([&]<int G>() KTE_INLINE_LAMBDA { this->template load_group<G>(d); });
    sum_answers<forces>(left_, rate_, m);
    each_jointless_mass([&m]<int Row>(std::integral_constant<int, Row>, const S& mass) KTE_INLINE_LAMBDA {
      m.col(Row).setZero(), m.row(Row).setZero();
      m(Row, Row) = S(1) / mass;
    });
  }
  /// The loads due to the forces of group G, from its tip to the base, and their components on axes.
  template <std::size_t G, class Driver>
  KTE_INLINE void load_group(const Driver& d) {
    d.template to_base<std::size_t{forces.group[G].tip}>(
        no_wrench, [this]<class B>(const B& b, const auto& load) KTE_INLINE_LAMBDA {
          const auto unit = forces.template units<simd, S, G, B::axes>(b.first());
          const auto beyond = engine::load_beyond_axes<B::axes - 1>(
              b, load, [&unit](auto k) KTE_INLINE_LAMBDA { return unit[std::size_t{k}]; },
              this->factors_.data() + b.first(),
              [this, &b](int k, const simd& e) KTE_INLINE_LAMBDA {
                const auto row = static_cast<std::size_t>(b.first() + k);
                tree::store<S>(e, left_[row].data() + width * G);
                tree::store<S>(simd(this->factors_[row].inverse * e), rate_[row].data() + width * G);
              });
          return engine::pulled_back(b, beyond);
        });
  }
  /// Calls f(row, mass) for each degree of freedom that moves no joint.
  template <class F>
  KTE_INLINE void each_jointless_mass(const F& f) const {
    unroll<int{wiring::freedoms}>([&]<int N>() KTE_INLINE_LAMBDA {
      if constexpr (base::template moves_no_joint<std::size_t{N}>()) {
        constexpr freedom at = wiring::template free<std::size_t{N}>;
        f(std::integral_constant<int, at.v>{}, as<S>(this->template mass_on_coordinate<S, at.what, at.slot>()));
      }
    });
  }

  template <std::size_t N>
  using rows = std::array<std::array<S, N>, std::size_t{Chain::dofs}>;
  rows<forces.groups * width> left_, rate_;  ///< e_ij and D_i^-1 e_ij: row i, column j
};

}  // namespace kte::detail
