#include "foxglove.hpp"

#include <kte/io/mcap_records.hpp>

#include <algorithm>

namespace kte::view {

const std::string_view frame_transforms_schema = R"({"title":"foxglove.FrameTransforms","type":"object","properties":{
"transforms":{"type":"array","items":{"type":"object","properties":{
"timestamp":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},
"parent_frame_id":{"type":"string"},"child_frame_id":{"type":"string"},
"translation":{"type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"}}},
"rotation":{"type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"},"w":{"type":"number"}}}
}}}}})";
const std::string_view scene_update_schema = R"({"title":"foxglove.SceneUpdate","type":"object","properties":{
"deletions":{"type":"array","items":{"type":"object"}},
"entities":{"type":"array","items":{"type":"object","properties":{
"timestamp":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},
"lifetime":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},
"frame_id":{"type":"string"},"id":{"type":"string"},"frame_locked":{"type":"boolean"},
"metadata":{"type":"array","items":{"type":"object"}},"arrows":{"type":"array","items":{"type":"object"}},
"cubes":{"type":"array","items":{"type":"object"}},"spheres":{"type":"array","items":{"type":"object"}},
"cylinders":{"type":"array","items":{"type":"object"}},"lines":{"type":"array","items":{"type":"object"}},
"triangles":{"type":"array","items":{"type":"object"}},"texts":{"type":"array","items":{"type":"object"}},
"models":{"type":"array","items":{"type":"object"}}}}}}})";

namespace {
void put_xyz(json_text& out, double x, double y, double z) {
  out.open_object();
  out.key("x"), out.number(x), out.key("y"), out.number(y), out.key("z"), out.number(z);
  out.close_object();
}
void put_xyz(json_text& out, const vec3<>& v) { put_xyz(out, v.x, v.y, v.z); }
void put_rotation(json_text& out, const unit_quaternion<>& q) {
  out.open_object();
  out.key("x"), out.number(q.x), out.key("y"), out.number(q.y), out.key("z"), out.number(q.z), out.key("w"),
      out.number(q.w);
  out.close_object();
}
void put_pose(json_text& out, const placed& p) {
  out.key("pose"), out.open_object();
  out.key("position"), put_xyz(out, p.position);
  out.key("orientation"), put_rotation(out, p.rotation);
  out.close_object();
}
void put_colour(json_text& out, const std::vector<double>& c) {
  static const std::vector<double> grey{0.6, 0.6, 0.65, 1};
  const auto& x = c.size() == 4 ? c : grey;
  out.key("color"), out.open_object();
  out.key("r"), out.number(x[0]), out.key("g"), out.number(x[1]), out.key("b"), out.number(x[2]), out.key("a"),
      out.number(x[3]);
  out.close_object();
}

/// The primitives of one frame, by the lists that they go into.
struct primitives {
  json_text cubes, spheres, cylinders, triangles;
  std::size_t count = 0;

  void add(json_text& list, const placed& at, const std::array<double, 3>& size, const std::vector<double>& colour) {
    begin(list, at);
    list.key("size"), put_xyz(list, size[0], size[1], size[2]);
    if (&list == &cylinders) list.key("bottom_scale"), list.number(1), list.key("top_scale"), list.number(1);
    end(list, colour);
  }
  void add(const scene::mesh& m, const placed& at, const std::vector<double>& colour) {
    begin(triangles, at);
    triangles.key("points"), triangles.open_list();
    for (std::size_t i = 0; i < m.positions.size(); i += 3)
      put_xyz(triangles, m.positions[i], m.positions[i + 1], m.positions[i + 2]);
    triangles.close_list();
    triangles.key("indices"), triangles.list(m.indices);
    triangles.key("colors"), triangles.list(std::vector<int>());
    end(triangles, colour);
  }
  void add(const scene& s, const scene::shape& x) {
    const auto at = place_of(x.place);
    const auto& l = x.size;
    const auto length = [&s](double given) { return given > 0 ? given : 10 * s.size; };
    const auto turned = [&](double z) { return at * placed{{0, 0, z}, {}}; };
    if (x.type == "mesh") return add(s.meshes[static_cast<std::size_t>(x.mesh)], at, x.colour);
    if (x.type == "box") return add(cubes, at, {l[0], l[1], l[2]}, x.colour);
    if (x.type == "sphere") return add(spheres, at, {2 * l[0], 2 * l[0], 2 * l[0]}, x.colour);
    if (x.type == "ellipsoid") return add(spheres, at, {2 * l[0], 2 * l[1], 2 * l[2]}, x.colour);
    if (x.type == "plane") return add(cubes, at, {length(l[0]), length(l[1]), 1e-3 * s.size}, x.colour);
    add(cylinders, at, {2 * l[0], 2 * l[0], x.contact ? length(l[1]) : l[1]}, x.colour);
    if (x.type != "capsule") return;
    for (const double z : {-l[1] / 2, l[1] / 2}) add(spheres, turned(z), {2 * l[0], 2 * l[0], 2 * l[0]}, x.colour);
  }

 private:
  void begin(json_text& list, const placed& at) {
    ++count;
    list.open_object();
    put_pose(list, at);
  }
  static void end(json_text& list, const std::vector<double>& colour) {
    put_colour(list, colour);
    list.close_object();
  }
};
}  // namespace

foxglove_messages::foxglove_messages(const scene& s) : s_(s), r_(s.recordings.front()) {
  const auto taken = [&s](const std::string& name) {
    return std::any_of(s.frames.begin(), s.frames.end(), [&](const auto& f) { return f.name == name; });
  };
  while (taken(origin_)) origin_ += '_';
}

void foxglove_messages::stamp(json_text& out, std::string_view key, std::size_t row) const {
  const auto ns = detail::mcap_time(r_.t[row]);
  out.key(key), out.open_object();
  out.key("sec"), out.number(ns / 1000000000), out.key("nsec"), out.number(ns % 1000000000);
  out.close_object();
}

std::string foxglove_messages::transforms(std::size_t row, bool moving) const {
  json_text out;
  out.open_object();
  out.key("transforms"), out.open_list();
  for (const auto& f : s_.frames) {
    if ((f.track >= 0) != moving) continue;
    const auto at = moving ? place_of(s_, r_, row, f.track) : place_of(f.place);
    out.open_object();
    stamp(out, "timestamp", row);
    out.key("parent_frame_id");
    out.text(moving || f.parent < 0 ? std::string_view(origin_) : s_.frames[static_cast<std::size_t>(f.parent)].name);
    out.key("child_frame_id"), out.text(f.name);
    out.key("translation"), put_xyz(out, at.position);
    out.key("rotation"), put_rotation(out, at.rotation);
    out.close_object();
  }
  out.close_list();
  out.close_object();
  return std::move(out.out());
}

/// Up to the lists of primitives.
void foxglove_messages::entity(json_text& out, std::string_view id, std::string_view frame, std::size_t row) const {
  stamp(out, "timestamp", row);
  out.key("frame_id"), out.text(frame), out.key("id"), out.text(id);
  out.key("lifetime"), out.open_object();
  out.key("sec"), out.number(0), out.key("nsec"), out.number(0);
  out.close_object();
  out.key("frame_locked"), out.boolean(true);
  for (const char* none : {"metadata", "arrows", "texts", "models"}) {
    out.key(none), out.open_list();
    out.close_list();
  }
}

std::string foxglove_messages::solids() const {
  json_text out;
  out.open_object();
  out.key("deletions"), out.open_list();
  out.close_list();
  out.key("entities"), out.open_list();
  for (std::size_t i = 0; i < s_.frames.size(); ++i) {
    primitives p;
    for (const auto& x : s_.shapes)
      if (static_cast<std::size_t>(x.frame) == i && !x.collision) p.add(s_, x);
    const bool shaped = p.count > 0;  // bodies of what has a shape are not drawn
    for (const auto& b : s_.bodies) {
      if (static_cast<std::size_t>(b.frame) != i || shaped) continue;
      const auto& q = b.orientation;
      std::array<double, 3> size{};
      for (std::size_t k = 0; k < 3; ++k) size[k] = std::max(2 * b.ellipsoid[k], 0.02 * s_.size);
      p.add(p.spheres, {{b.centre[0], b.centre[1], b.centre[2]}, {q[0], q[1], q[2], q[3]}}, size, {});
    }
    if (p.count == 0) continue;
    out.open_object();
    entity(out, s_.frames[i].name, s_.frames[i].name, 0);
    for (const auto& [key, list] : {std::pair("cubes", &p.cubes), std::pair("spheres", &p.spheres),
                                    std::pair("cylinders", &p.cylinders), std::pair("triangles", &p.triangles)}) {
      out.key(key), out.raw('[' + list->out() + ']');
    }
    out.key("lines"), out.open_list();
    out.close_list();
    out.close_object();
  }
  out.close_list();
  out.close_object();
  return std::move(out.out());
}

std::string foxglove_messages::lines(std::size_t row) const {
  const auto places = frame_places(s_, r_, row);
  const auto at = [&places](int frame) { return places[static_cast<std::size_t>(frame)].position; };
  std::vector<std::pair<int, int>> links, forces;
  for (const auto& l : s_.links) links.emplace_back(l.from, l.to);
  for (const auto& f : s_.forces)
    for (std::size_t k = 1; k < f.frames.size(); ++k) forces.emplace_back(f.frames[0], f.frames[k]);
  json_text out;
  out.open_object();
  out.key("deletions"), out.open_list();
  out.close_list();
  out.key("entities"), out.open_list();
  out.open_object();
  entity(out, "lines", origin_, row);
  for (const char* none : {"cubes", "spheres", "cylinders", "triangles"}) {
    out.key(none), out.open_list();
    out.close_list();
  }
  out.key("lines"), out.open_list();
  for (const auto* list : {&links, &forces}) {
    if (list->empty()) continue;
    out.open_object();
    out.key("type"), out.number(2);  // pairs of points
    put_pose(out, {});
    out.key("thickness"), out.number(0.01 * s_.size), out.key("scale_invariant"), out.boolean(false);
    out.key("points"), out.open_list();
    for (const auto& [from, to] : *list) put_xyz(out, at(from)), put_xyz(out, at(to));
    out.close_list();
    put_colour(out, list == &links ? std::vector<double>() : std::vector<double>{0.85, 0.45, 0.1, 1});
    out.key("colors"), out.list(std::vector<int>());
    out.key("indices"), out.list(std::vector<int>());
    out.close_object();
  }
  out.close_list();
  out.close_object();
  out.close_list();
  out.close_object();
  return std::move(out.out());
}

}  // namespace kte::view
