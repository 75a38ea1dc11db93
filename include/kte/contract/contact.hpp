#pragma once

#include <kte/contract/contact_between.hpp>
#include <kte/frames/contact_state.hpp>

namespace kte {

/// Dry friction and restitution of a rigid contact.
struct contact_law {
  double friction = 0;     ///< Coulomb's coefficient
  double restitution = 0;  ///< Newton's coefficient, 0 to 1
};

namespace detail {
/// A contact at a position, and its motion.
template <class S>
struct basic_touch {
  vec3<S> normal;  ///< n, unit, from the surface of A to the body B, in axes of A
  vec3<S> point;   ///< where the force acts
  S gap{};
  S bending{};        ///< g'' - n . u', from the curvature of the surface
  vec3<S> slip;       ///< u
  vec3<S> slip_rate;  ///< u'
  contact_law law;
};
using touch = basic_touch<double>;
template <kind Dim>
inline constexpr std::array<port, 3> contact_ports{
    {{Dim, access::on, "frame1"}, {Dim, access::on, "frame2"}, {kind::contact, access::keep, "contact"}}};
/// Whether it is a contact with `only_if`: `admits(s)` returns whether it acts, for a state s after doMotion.
template <class Core>
concept has_gate = requires {
  requires Core::has_gate;
};
}  // namespace detail

/// A rigid contact of a body B with a surface of a frame A. A core derived from it has a `contact_law law`, and
///
///   gap(m)          g: distance of the body from the surface, m, negative inside          (1)
///   normal(m)       n: the unit normal of the surface there, towards the body
///   gap_ddot(m)     its second derivative, with accelerations; n . u' if the normal is constant
///   point(m)        c: the point of contact
///   slip(m)         u: velocity of the material point of B at c relative to A, linear in the rates of m          (2)
///   slip_rate(m)    its derivative, with accelerations          (3)
///
/// in axes of A, where m is the motion of B in A, as for closures. The rate of the gap is n . u. Algorithms use the
/// rows of a closed contact as those of a closure with the residual g n and the rate u: a contact that sticks has three
/// rows, two in the plane. The ports are A, B and the name of the contact.
///
/// The force f on B acts at c, the opposite on A at the same c: its power is f . u for any gap.
template <class Core, kind Dim>
struct contact {
  static constexpr bool reads_positions = true;  ///< gaps depend on them
  static constexpr auto ports = detail::contact_ports<Dim>;
  static constexpr closure_rows rows{Dim == kind::frame_2D ? 2 : 3, 0};

  /// (1) as rows: g n.
  template <class M>
  constexpr auto residual(const M& m) const {
    return rows_of(core().gap(m) * core().normal(m));
  }
  /// (2) as rows.
  template <class M>
  constexpr auto residual_dot(const M& m) const {
    return rows_of(core().slip(m));
  }
  /// (3) as rows.
  template <class M>
  constexpr auto residual_ddot(const M& m) const {
    return rows_of(core().slip_rate(m));
  }
  template <class A, class B, class Contact>
  KTE_INLINE constexpr auto doForce(const A& a, const B& b, const Contact& x) const {
    using S = std::remove_cvref_t<decltype(x.gap)>;
    if constexpr (typed_constant<S>) {
      return make_loads(no_wrench, no_wrench);  // a contact without force
    } else {
      const auto m = detail::as_closing_motion<S>(relative(a, b));
      return detail::loads_at_contact<Dim>(m, x.force, as<S>(core().point(m)));
    }
  }
  /// Writes gap, slip and point, of a disc that lies flat those of its centre; called by doMotion.
  template <class A, class B, class S>
  constexpr void put_contact(const A& a, const B& b, contact_state<S>& x) const {
    const auto m = detail::as_closing_motion<S>(relative(spatial(a), spatial(b)));
    x.gap = as<S>(core().gap(m));
    if constexpr (requires { core().geometry.place(m); }) {
      const auto [point, slip] = core().geometry.place(m);
      x.point = as<S>(point), x.slip = as<S>(slip);
    } else {
      x.point = as<S>(core().point(m)), x.slip = as<S>(core().slip(m));
    }
  }
  /// The distance of the farthest point of the shape from the origin of its frame, m: the scale of tolerances.
  constexpr double size() const {
    if constexpr (requires { core().geometry.size(); })
      return core().geometry.size();
    else
      return 0;
  }
  /// The place of the contact for the motion m.
  template <class S>
  constexpr detail::basic_touch<S> touch_at(const detail::closing_motion<S>& m) const {
    const auto n = as<S>(core().normal(m)), rate = as<S>(core().slip_rate(m));
    return {n,
            as<S>(core().point(m)),
            as<S>(core().gap(m)),
            S(as<S>(core().gap_ddot(m)) - dot(n, rate)),
            as<S>(core().slip(m)),
            rate,
            core().law};
  }

 private:
  KTE_INLINE constexpr const Core& core() const { return static_cast<const Core&>(*this); }
  template <class V>
  static constexpr auto rows_of(const V& v) {
    if constexpr (Dim == kind::frame_2D)
      return make_rows(v.x, v.y);
    else
      return make_rows(v.x, v.y, v.z);
  }
};

}  // namespace kte
