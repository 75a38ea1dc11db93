#include "contact_shapes.hpp"

#include <Eigen/Geometry>

#include <algorithm>

#include "element_parameters.hpp"

namespace kte::view {

namespace {
using direction = std::array<double, 3>;

/// At a point, with the z axis along a direction.
scene::pose along(const direction& axis, const std::array<double, 3>& at = {}) {
  const auto q = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), Eigen::Vector3d(axis.data()));
  return {at[0], at[1], at[2], q.w(), q.x(), q.y(), q.z()};
}
scene::shape shape_of(int frame, const scene::pose& place, std::string type, std::vector<double> size) {
  scene::shape x{frame, place, std::move(type), std::move(size), {}};
  x.contact = true;
  return x;
}
/// The surface of a contact (contact/surfaces.hpp); without a type if it is another.
scene::shape surface_of(const detail::element_parts& e, int frame) {
  const bool flat = e.type.ends_with("_2D"), disc = parameter_count(e, "normal") == 3;
  if (!disc && parameter_count(e, "surface_axis") != 3) return shape_of(frame, scene::at_origin, "", {});
  const direction up{0, flat ? 1.0 : 0.0, flat ? 0.0 : 1.0};
  const auto axis = vector_parameter(e, disc ? "normal" : "surface_axis", {});
  const double radius = std::abs(disc ? 0 : number_parameter(e, "surface_radius", 0));
  const bool round = axis == direction{};
  if (radius == 0) return shape_of(frame, along(round ? up : axis), "plane", {0, 0});
  auto x = round ? shape_of(frame, scene::at_origin, "sphere", {radius})
                 : shape_of(frame, along(axis), "cylinder", {radius, 0});
  x.colour = {0.5, 0.55, 0.6, 0.35};  // what is in a bowl is seen
  return x;
}
bool same(const scene::shape& a, const scene::shape& b) {
  return a.frame == b.frame && a.type == b.type && a.place == b.place && a.size == b.size;
}
}  // namespace

void add_contact_shapes(scene& s, const std::vector<drawn_contact>& contacts) {
  const bool shaped = !s.shapes.empty();
  const auto is_drawn = [&s](const scene::shape& x) {
    return std::any_of(s.shapes.begin(), s.shapes.end(), [&x](const scene::shape& y) {
      return same(x, y) || (x.type == "plane" && y.type == "plane" && x.frame == y.frame && !y.collision);
    });
  };
  for (const auto& c : contacts) {
    const auto& e = *c.element;
    auto surface = surface_of(e, c.surface);
    if (surface.type.empty())
      s.notes.push_back("the surface of " + e.type + " '" + s.frames[static_cast<std::size_t>(c.surface)].name +
                        "' is not drawn: it is a height field or a function");
    else if (!is_drawn(surface))
      s.shapes.push_back(std::move(surface));
    if (shaped) continue;
    const double radius = number_parameter(e, "radius", 0);
    if (parameter_count(e, "axis") == 3)
      s.shapes.push_back(
          shape_of(c.body, along(vector_parameter(e, "axis", {0, 0, 1})), "cylinder", {radius, 0.02 * radius}));
    else
      s.shapes.push_back(shape_of(c.body, along({0, 0, 1}, vector_parameter(e, "offset", {})), "sphere", {radius}));
  }
}

}  // namespace kte::view
