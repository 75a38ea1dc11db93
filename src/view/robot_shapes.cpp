#include <kte/math/quaternion.hpp>
#include <kte/robots/detail/shape_names.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "mesh_files.hpp"
#include "scene_builder.hpp"

namespace kte::view {

namespace {
using form = robot_shape::form;

std::string place_text(const robot_shape& x) { return x.line > 0 ? "line " + std::to_string(x.line) + ": " : ""; }

/// Type and sizes of a form that is no mesh, or false.
bool describe(const robot_shape& x, scene::shape& s) {
  const auto& l = x.size;
  switch (x.is) {
    case form::box:
      s.type = "box", s.size = {l.x, l.y, l.z};
      return true;
    case form::sphere:
      s.type = "sphere", s.size = {l.x};
      return true;
    case form::cylinder:
      s.type = "cylinder", s.size = {l.x, l.y};
      return true;
    case form::capsule:
      s.type = "capsule", s.size = {l.x, l.y};
      return true;
    case form::ellipsoid:
      s.type = "ellipsoid", s.size = {l.x, l.y, l.z};
      return true;
    case form::plane:
      s.type = "plane", s.size = {2 * l.x, 2 * l.y};
      return true;
    default:
      return false;
  }
}
bool can_be_drawn(const scene::shape& s) {
  const auto finite = [](double x) { return std::isfinite(x); };
  return std::all_of(s.place.begin(), s.place.end(), finite) && std::all_of(s.size.begin(), s.size.end(), finite);
}
scene::pose place_of(const robot_pose& p) {
  const auto q = to_quaternion(p.rotation);
  return {p.position.x, p.position.y, p.position.z, q.w, q.x, q.y, q.z};
}
std::vector<double> colour_of(const robot_shape& x) {
  if (x.rgba.size() < 3) return {};
  std::vector<double> c(4, 1.0);
  for (std::size_t i = 0; i < 4 && i < x.rgba.size(); ++i)
    c[i] = x.rgba[i] > 0 ? std::min(x.rgba[i], 1.0) : 0;  // NaN is 0
  return c;
}
}  // namespace

void add_shapes(scene& s, const detail::chain_parts& chain) {
  std::unordered_map<std::string_view, int> frames;
  for (std::size_t i = 0; i < s.frames.size(); ++i) frames.emplace(s.frames[i].name, static_cast<int>(i));
  mesh_files meshes(s, chain.file, chain.search_path);
  std::set<int> seen, unseen;  // frames that have a shape to see, or one that cannot be drawn
  detail::shape_names names;
  for (const auto& part : chain.shapes) names.add(part.frame, *part.shape, part.collision);
  for (const auto& part : chain.shapes) {
    const auto& x = *part.shape;
    const auto what = place_text(x) + names.of(x) + " of '" + std::string(part.frame) + "'";
    const auto at = frames.find(part.frame);
    if (at == frames.end()) {
      s.notes.push_back(what + " is not drawn: the chain has no frame of this name");
      continue;
    }
    scene::shape drawn{at->second, place_of(x.origin), {}, {}, colour_of(x), part.collision};
    bool ok = true;
    if (x.is == form::mesh) {
      drawn.type = "mesh", drawn.mesh = meshes.index_of(x.mesh, x.scale, part.file, part.frame);
      ok = drawn.mesh >= 0;
    } else if (!describe(x, drawn)) {
      s.notes.push_back(what + " is not drawn: it is a height field, or has no geometry that is read");
      ok = false;
    }
    if (ok && !can_be_drawn(drawn)) {
      s.notes.push_back(what + " is not drawn: its numbers are not finite");
      ok = false;
    }
    if (!part.collision) (ok ? seen : unseen).insert(drawn.frame);
    if (ok) s.shapes.push_back(std::move(drawn));
  }
  for (const int f : unseen) {
    if (seen.contains(f)) continue;
    bool instead = false;
    for (auto& x : s.shapes)
      if (x.frame == f && x.collision) x.collision = false, instead = true;
    if (instead)
      s.notes.push_back("'" + s.frames[static_cast<std::size_t>(f)].name +
                        "' is drawn by its collision shapes, because none of its visual shapes can be drawn");
  }
}

}  // namespace kte::view
