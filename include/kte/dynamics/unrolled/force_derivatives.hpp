#pragma once

#include <kte/dynamics/unrolled/bodies.hpp>
#include <kte/dynamics/unrolled/given.hpp>
#include <kte/recursions/force_variations.hpp>

/// Derivatives of inverse dynamics of static chains (recursions/force_variations.hpp).
namespace kte::detail {

/// Joint or link I in motion, and what is felt from it.
template <class S, class Pass, std::size_t I, class Axes>
struct typed_moving_body : typed_body<S, Pass, I, Axes> {
  using base = typename typed_body<S, Pass, I, Axes>::base;
  using end = typename typed_body<S, Pass, I, Axes>::end;

  KTE_INLINE constexpr auto relative() const {
    if constexpr (coordinates_of<typename Pass::types::template core<I>> == 1) {
      return this->motion.chain().template core<I>().relative(this->motion.template joint_coordinate<I>());
    } else {
      return this->motion.chain().template core<I>().relative();
    }
  }
  KTE_INLINE constexpr decltype(auto) parent_motion() const {
    return this->motion.template get<base::what, base::slot>();
  }
  KTE_INLINE constexpr auto load() const { return this->motion.template load<end::what, end::slot>(); }
};

/// Motion, forces, and the derivatives of the forces on joints, of a tree of joints.
template <class S, class Chain, class Given>
class unrolled_force_derivatives : public unrolled_passes<Chain, Given> {
  using pass = unrolled_passes<Chain, Given>;

 public:
  using matrix = joint_matrix<S, Chain::dofs>;

  /// Puts the derivatives into matrices of zeros.
  KTE_INLINE unrolled_force_derivatives(const Chain& c, const Given& g, matrix& by_q, matrix& by_v, matrix& by_a)
      : pass(c, g) {
    using bodies_type = typed_bodies<S, pass, axes_of_dofs<Chain>, typed_moving_body>;
    const bodies_type bodies{*this};
    derivatives_of_forces(engine::unrolled<bodies_type>{bodies}, entries{by_q, by_v, by_a});
  }

 private:
  struct entries {
    matrix &of_q, &of_v, &of_a;
    template <class X>
    KTE_INLINE constexpr void by_q(int i, int j, const X& x) const {
      of_q(i, j) = as<S>(x);
    }
    template <class X>
    KTE_INLINE constexpr void by_v(int i, int j, const X& x) const {
      of_v(i, j) = as<S>(x);
    }
    template <class X>
    KTE_INLINE constexpr void by_a(int i, int j, const X& x) const {
      of_a(i, j) = as<S>(x);
    }
  };
};

}  // namespace kte::detail
