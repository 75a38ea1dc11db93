#pragma once

#include <kte/robots/detail/angles.hpp>
#include <kte/robots/detail/shape_names.hpp>
#include <kte/robots/detail/unwritten.hpp>
#include <kte/robots/detail/xml_writer.hpp>

#include <charconv>
#include <map>
#include <numbers>

namespace kte::detail {

/// An angle rounded to this number of decimals; quarter turns keep all digits.
inline double cut_angle(double x, int decimals) {
  if (nearest_quarter(x).distance <= 1e-15) return x;
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, x, std::chars_format::fixed, decimals).ptr;
  double y{};
  std::from_chars(digits, end, y);
  return y + 0.0;
}

/// Roll, pitch and yaw that a reader turns into the same rotation. Angles in files have few decimals and may lie
/// outside of the ranges of `rpy_of_rotation`: pitch pi - p with roll and yaw half a turn further, or angles a full
/// turn further. If none of these gives the same bits, the result is that of `rpy_of_rotation`.
inline vec3<> rpy_in_file(const mat3<vec3<>>& m) {
  constexpr double half = std::numbers::pi;
  const auto all = rpy_of_rotation(m);
  const auto other = [](double x) { return x > 0 ? x - half : x + half; };
  const vec3<> flipped{other(all.x), (all.y < 0 ? -half : half) - all.y, other(all.z)};
  for (const int decimals : {5, 8, 11, 15})
    for (int way = 0; way < 16; ++way) {
      const auto cut = [&](double x, bool turn) {
        return cut_angle(turn ? x + (x > 0 ? -2 * half : 2 * half) : x, decimals);
      };
      const auto& from = way & 8 ? flipped : all;
      const vec3<> few{cut(from.x, way & 1), cut(from.y, way & 2), cut(from.z, way & 4)};
      if (rotation_of_rpy(few, 1e-15) == m) return few;
    }
  return all;
}

inline void write_urdf_pose(xml_writer& out, const robot_pose& p) {
  out.attribute("xyz", p.position);
  if (p.rotation != robot_pose{}.rotation) out.attribute("rpy", rpy_in_file(p.rotation));
}
inline void write_urdf_origin(xml_writer& out, const robot_pose& p) {
  if (is_nothing(p)) return;
  out.open("origin"), write_urdf_pose(out, p), out.close();
}

/// Shapes in URDF: boxes, spheres, cylinders and meshes.
class urdf_shapes {
 public:
  urdf_shapes(xml_writer& out, const robot_writing& o, unwritten& left_out) : out_(out), o_(o), left_out_(left_out) {}

  void write(const robot_link& l) {
    shape_names names;
    for (const auto& s : l.visuals) names.add(l.name, s, false);
    for (const auto& s : l.collisions) names.add(l.name, s, true);
    const auto write = [&](const char* what, const robot_shape& s) {
      title_ = "link '" + l.name + "': its " + names.of(s);
      shape(what, s);
    };
    for (const auto& s : l.visuals) write("visual", s);
    for (const auto& s : l.collisions) write("collision", s);
  }

 private:
  using form = robot_shape::form;

  void note(const robot_shape& s, const std::string& what) { left_out_.list(s.line, title_ + what); }
  void shape(const char* what, robot_shape s) {
    if (s.is == form::none || s.is == form::height_field)
      return note(s, s.is == form::none ? " is left out: its form is not known" : " is left out: it is a height field");
    if (s.is == form::ellipsoid) return note(s, " is left out: it is an ellipsoid");
    if (s.is == form::plane) return note(s, " is left out: it is a plane");
    if (s.is == form::mesh) {
      const auto path = o_.mesh_path && !s.mesh.empty() ? o_.mesh_path(s.mesh) : s.mesh;
      if (path.empty()) return note(s, " is left out: its mesh '" + s.mesh + "' has no file");
      s.mesh = path;
    }
    if (s.is != form::capsule) return simple(what, s);
    note(s, ": a capsule is written as a cylinder and two balls");
    auto part = s;
    part.is = form::cylinder;
    simple(what, part);
    part.is = form::sphere;
    for (const double end : {-0.5, 0.5}) {
      part.origin.position = s.origin.position + s.origin.rotation * vec3<>{0, 0, end * s.size.y};
      simple(what, part);
    }
  }
  void simple(const char* what, const robot_shape& s) {
    out_.open(what);
    if (!s.name.empty()) out_.attribute("name", std::string_view(s.name));
    write_urdf_origin(out_, s.origin);
    out_.open("geometry");
    if (s.is == form::box) out_.leaf("box", "size", s.size);
    if (s.is == form::sphere) out_.leaf("sphere", "radius", s.size.x);
    if (s.is == form::cylinder) {
      out_.open("cylinder"), out_.attribute("radius", s.size.x), out_.attribute("length", s.size.y), out_.close();
    }
    if (s.is == form::mesh) {
      out_.open("mesh"), out_.attribute("filename", std::string_view(s.mesh));
      if (s.scale != vec3<>{1, 1, 1}) out_.attribute("scale", s.scale);
      out_.close();
    }
    out_.close();
    material(s);
    out_.close();
  }
  /// Writes the material of a shape. In a URDF a name stands for one colour in the whole file.
  void material(const robot_shape& s) {
    const auto rgba = colour_of(s);
    if (s.material.empty() && rgba.empty()) return;
    auto name = s.material;
    if (!name.empty() && !rgba.empty())
      while (colours_.emplace(name, rgba).first->second != rgba) name += '\'';
    if (name != s.material)
      note(s, ": its material is called \"" + name + "\", as '" + s.material + "' has another colour elsewhere");
    out_.open("material"), out_.attribute("name", std::string_view(name));
    if (!rgba.empty()) out_.leaf("color", "rgba", rgba);
    out_.close();
  }

  xml_writer& out_;
  const robot_writing& o_;
  unwritten& left_out_;
  std::string title_;  ///< of the shape that is written
  std::map<std::string, std::vector<double>, std::less<>> colours_;
};

}  // namespace kte::detail
