#pragma once

#include <kte/manipulators/detail/arm_structure.hpp>
#include <kte/manipulators/detail/static_geometry.hpp>
#include <kte/models/joint_limits.hpp>
#include <kte/models/manipulator_kinematics_model.hpp>

namespace kte {

namespace detail {
template <key_type... Tools>
struct tool_keys {};

template <class T>
inline constexpr bool is_limits = false;
template <class Numbers>
inline constexpr bool is_limits<joint_limits<Numbers>> = true;

/// The keys of a list that may end with limits.
template <class Keys, class... Rest>
struct keys_before_limits {
  using type = Keys;
};
template <class... Keys, class First, class... Rest>
requires(!is_limits<First>) struct keys_before_limits<tool_keys<Keys...>, First, Rest...>
    : keys_before_limits<tool_keys<Keys..., First>, Rest...> {
};
}  // namespace detail

/// A chain with tools and limits of its coordinates, for inverse kinematics. It derives from the chain, as
/// `manipulator_kinematics_model` does, so that all algorithms and files accept it.
///
///   constexpr auto arm = kte::manipulator(chain, tool);            // or (chain, left, right)
///   constexpr auto arm = kte::manipulator(chain, tool, limits);    // joint_limits of the chain, kte::unlimited(chain)
///
/// Runtime chains: manipulators/runtime_manipulator.hpp.
template <class Chain, class Tools = void>
class manipulator;

template <class Chain, key_type... Tools>
class manipulator<Chain, detail::tool_keys<Tools...>> : public manipulator_kinematics_model<Chain, Tools...> {
  using model = manipulator_kinematics_model<Chain, Tools...>;
  using first_tool = std::tuple_element_t<0, std::tuple<Tools...>>;

 public:
  using limits_type = joint_limits<std::array<double, std::size_t{Chain::dofs}>>;

  explicit constexpr manipulator(const Chain& c, const Tools&... tools)
      : model(c, tools...), structure_(detail::structure_of(detail::geometry_of<first_tool>(c))) {}
  /// A manipulator with its limits. Throws `bad_parameter`, naming the coordinate, for invalid limits (`check_limits`).
  template <class Numbers>
  constexpr manipulator(const Chain& c, const Tools&... tools, const joint_limits<Numbers>& limits)
      : manipulator(c, tools...) {
    limits_ = checked(c, limits);
  }

  /// The limits; infinite if none were given.
  [[nodiscard]] constexpr const limits_type& limits() const { return limits_; }
  /// The family of its closed-form inverse kinematics, found from the axes of the joints that move the first tool; at
  /// compile time for a `constexpr` arm.
  [[nodiscard]] constexpr arm_family family() const { return structure_.family; }
  /// The structure of the arm on which its closed form depends.
  [[nodiscard]] constexpr const detail::arm_structure& structure() const { return structure_; }
  /// A copy of the arm in which axes count as parallel within `tolerance`, rad, and as intersecting within this
  /// fraction of the reach, instead of 1e-9. Use it for calibrated arms, and for files with 1.5708 for a quarter turn.
  /// For six and seven axes, the closed forms are then start values of Newton's method, whose solutions are exact,
  /// except near singular postures.
  [[nodiscard]] constexpr manipulator with_axes_within(double tolerance) const {
    auto arm = *this;
    arm.structure_ = detail::structure_of(structure_.original, detail::checked_tolerance(tolerance));
    return arm;
  }

 private:
  template <class Numbers>
  static constexpr limits_type checked(const Chain& c, const joint_limits<Numbers>& limits) {
    constexpr bool sized = std::is_same_v<joint_limits<Numbers>, limits_type>;
    static_assert(sized,
                  "kte: the limits of a static chain need one number for each degree of freedom: begin with "
                  "kte::unlimited(chain)");
    if constexpr (sized) {
      check_limits(c, limits);
      return limits;
    } else {
      return {};  // avoids follow-up errors
    }
  }

  limits_type limits_{};
  detail::arm_structure structure_;
};
template <class Gravity, class... E, class... Rest>
manipulator(const static_chain<Gravity, E...>&, const Rest&...)
    -> manipulator<static_chain<Gravity, E...>,
                   typename detail::keys_before_limits<detail::tool_keys<>, Rest...>::type>;

}  // namespace kte
