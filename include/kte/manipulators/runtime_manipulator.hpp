#pragma once

#include <kte/manipulators/detail/runtime_geometry.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/models/runtime_models.hpp>

namespace kte {

/// `manipulator` of a runtime chain, with tools by name:
///
///   kte::manipulator arm(chain, "tool");
///   kte::manipulator arm(chain, {"left", "right"}, limits);
///
/// It has its own state; use one manipulator per thread.
template <>
class manipulator<runtime_chain, void> : public manipulator_kinematics_model<runtime_chain> {
  using model = manipulator_kinematics_model<runtime_chain>;

 public:
  using limits_type = joint_limits<>;

  /// A manipulator with its tools and limits. Throws `unknown_name` for a frame that the chain does not have,
  /// `bad_parameter` for invalid limits.
  manipulator(const runtime_chain& c, std::vector<std::string> tools, const joint_limits<>& limits);
  manipulator(const runtime_chain& c, std::vector<std::string> tools)
      : manipulator(c, std::move(tools), unlimited(c)) {}
  // A template for texts, because {"left", "right"} would otherwise also match a std::string made of two pointers.
  template <std::convertible_to<std::string> Text>
  manipulator(const runtime_chain& c, const Text& name_of_tool)
      : manipulator(c, std::vector<std::string>{name_of_tool}) {}
  template <std::convertible_to<std::string> Text>
  manipulator(const runtime_chain& c, const Text& name_of_tool, const joint_limits<>& limits)
      : manipulator(c, std::vector<std::string>{name_of_tool}, limits) {}

  [[nodiscard]] const joint_limits<>& limits() const { return limits_; }
  [[nodiscard]] arm_family family() const { return structure_.family; }
  [[nodiscard]] const detail::arm_structure& structure() const { return structure_; }
  [[nodiscard]] manipulator with_axes_within(double tolerance) const;

 private:
  joint_limits<> limits_;
  detail::arm_structure structure_;
};
template <class... Rest>
manipulator(const runtime_chain&, const Rest&...) -> manipulator<runtime_chain>;
manipulator(const runtime_chain&, std::initializer_list<const char*>)->manipulator<runtime_chain>;
manipulator(const runtime_chain&, std::initializer_list<const char*>, const joint_limits<>&)
    ->manipulator<runtime_chain>;

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte {

KTE_FUNCTION manipulator<runtime_chain, void>::manipulator(const runtime_chain& c, std::vector<std::string> tools,
                                                           const joint_limits<>& limits)
    : model(c, std::move(tools)), limits_(limits) {
  check_limits(*this, limits_);
  auto s = make_state();
  structure_ = detail::structure_of(detail::geometry_of(*this, s, this->tools()[0]));
}
KTE_FUNCTION manipulator<runtime_chain> manipulator<runtime_chain, void>::with_axes_within(double tolerance) const {
  auto arm = *this;
  arm.structure_ = detail::structure_of(structure_.original, detail::checked_tolerance(tolerance));
  return arm;
}

}  // namespace kte
#endif
