#pragma once

#include <kte/contact/height_field.hpp>
#include <kte/contact/height_grid.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/robots/detail/robot_ground.hpp>
#include <kte/robots/detail/touching_parts.hpp>

#include <map>

namespace kte::detail {

/// Appends contacts of parts of shapes with surfaces of the ground to the chain of a robot.
class contact_maker {
 public:
  contact_maker(robot_elements& to, const robot_contact_options& o) : to_(to), o_(o) {
    const auto refuse = [](const std::string& why) { raise<bad_argument>("kte: robot_options::contacts: " + why); };
    if (o.rim_points != 0 && (o.rim_points < 3 || o.rim_points > 64))
      refuse("rim_points must be 0 or from 3 to 64, got " + std::to_string(o.rim_points));
    if (!o.are_compliant()) return;
    if (o.compliant.friction != 0) refuse("the friction of compliant contacts is `friction`, beside `compliant`");
    if (o.restitution) refuse("compliant contacts have no coefficient of restitution: they have a dissipation");
  }

  /// An unused name for the contacts of a shape: its own, or that of its link and a suffix.
  std::string name_for(const std::string& wanted) {
    if (!to_.has(wanted)) return to_.fresh(wanted);
    std::string name = wanted + ".contact";
    for (auto& k = (copies_.try_emplace(wanted, 1).first->second); to_.has(name);)
      name = wanted + ".contact " + std::to_string(++k);
    return to_.fresh(name);
  }
  /// The contact of a part of a link; returns its name.
  std::string add(const ground_surface& g, const std::string& shape, const std::string& link, const touching_part& p,
                  const contact_law& law) {
    const auto name = shape + p.name;
    if (g.is_plane())
      on(half_space(g.normal), g, name, link, p, law);
    else
      on(field_of(*g.shape), g, name, link, p, law);
    return name;
  }

 private:
  /// The height field of a shape, made once.
  const height_field<height_grid>& field_of(const robot_shape& s) {
    if (const auto known = fields_.find(&s); known != fields_.end()) return known->second;
    const double columns = static_cast<double>(s.columns), rows = static_cast<double>(s.heights.size() / s.columns);
    const height_grid::layout at{-s.size.x, -s.size.y, 2 * s.size.x / (columns - 1), 2 * s.size.y / (rows - 1),
                                 s.columns};
    return fields_.emplace(&s, height_field(height_grid(at, s.heights))).first->second;
  }
  template <class Surface>
  void on(const Surface& surface, const ground_surface& g, const std::string& name, const std::string& link,
          const touching_part& p, const contact_law& law) {
    const bool soft = o_.are_compliant();
    auto with = o_.compliant;
    with.friction = law.friction;
    if constexpr (std::is_same_v<Surface, half_space>)
      if (p.axis) {
        const auto centre = p.at == vec3<>{} ? link : to_.fresh(name + ".centre");
        if (centre != link) to_.append_link(link, centre, {p.at, robot_pose{}.rotation});
        if (soft) return to_.append(compliant_disc_contact_3D(g.frame, centre, surface, *p.axis, p.radius, with));
        return to_.append(disc_contact_3D(name, g.frame, centre, surface, *p.axis, p.radius, law));
      }
    if (soft) return to_.append(compliant_contact_3D(g.frame, link, surface, p.radius, with, p.at));
    to_.append(sphere_contact_3D(name, g.frame, link, surface, p.radius, law, p.at));
  }

  robot_elements& to_;
  const robot_contact_options& o_;
  std::map<const robot_shape*, height_field<height_grid>> fields_;
  std::map<std::string, int> copies_;  ///< by name, the last number behind it
};

}  // namespace kte::detail
