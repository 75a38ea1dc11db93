#include "scene_builder.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "contact_shapes.hpp"
#include "element_kinds.hpp"
#include "element_parameters.hpp"
#include "model_json.hpp"

namespace kte::view {

namespace {
using detail::chain_parts;
using detail::element_parts;

/// Goes through the elements of a chain, in their order.
class scene_builder {
 public:
  explicit scene_builder(const chain_parts& chain) : chain_(chain) {
    for (std::size_t k = 0; k < kinds; ++k)
      for (const auto& x : chain.slots[k]) slots_[k].emplace(x.name, x.slot);
  }

  built_scene build() {
    auto& s = out_.picture;
    s.title = chain_.title, s.gravity = {chain_.gravity.x, chain_.gravity.y, chain_.gravity.z};
    s.dimension = slots(kind::frame_3D).empty() && !slots(kind::frame_2D).empty() ? 2 : 3;
    add_coordinates();
    for (const auto& e : chain_.elements) add_frames(e);
    for (const auto& e : chain_.elements) {
      add(e);
      if (kind_of_element(e.type).as != drawn::pull) ++element_;
    }
    give_ranges();
    if (s.frames.empty())
      s.notes.push_back("the chain has no frames: there is nothing to draw, and its coordinates are plotted");
    add_model();
    add_shapes(s, chain_);
    add_contact_shapes(s, contacts_);
    return std::move(out_);
  }

 private:
  const std::vector<detail::named_slot>& slots(kind k) const { return chain_.slots[static_cast<std::size_t>(k)]; }
  int slot_of(kind k, const std::string& name) const { return slots_[static_cast<std::size_t>(k)].at(name); }

  // ---- coordinates
  void add_coordinates() {
    const double none = scene::none;
    for (const auto& e : chain_.layout) {
      add_coordinate(e.name, e.what, e.q, e.v);
      out_.freedoms.push_back({e.what, slot_of(e.what, e.name)});
      const auto v = static_cast<std::size_t>(e.v);
      auto& c = out_.picture.coordinates.back();
      if (e.nv == 1 && v < chain_.lower.size()) c.lower = chain_.lower[v], c.upper = chain_.upper[v];
      if (!(c.lower <= c.upper)) c.lower = -none, c.upper = none;
    }
    for (const auto& e : chain_.elements)
      for (std::size_t p = 0; p < e.ports.size(); ++p)
        if (is_coordinate(e.ports[p].what) && !coordinates_.contains(e.names[p])) {
          add_coordinate(e.names[p], e.ports[p].what, -1, -1);
          out_.picture.coordinates.back().follows = true;
        }
  }
  void add_coordinate(const std::string& name, kind k, int q, int v) {
    coordinates_.emplace(name, static_cast<int>(out_.picture.coordinates.size()));
    const bool pose = k == kind::pose_2D || k == kind::pose_3D;
    out_.picture.coordinates.push_back({name,
                                        k == kind::gen           ? "number"
                                        : k == kind::rotation_3D ? "rotation"
                                        : k == kind::pose_2D     ? "pose_2D"
                                                                 : "pose",
                                        pose ? "m" : "1", q, nq_of(k), v, nv_of(k)});
  }
  int coordinate(const std::string& name) const { return coordinates_.at(name); }

  // ---- frames
  int frame(kind k, const std::string& name) {
    const auto [known, fresh] = frames_.emplace(name, static_cast<int>(out_.picture.frames.size()));
    if (fresh) {
      out_.picture.frames.push_back({name, out_.picture.tracks++});
      out_.tracked.push_back({k, slot_of(k, name)});
    }
    return known->second;
  }
  void add_frames(const element_parts& e) {
    for (std::size_t p = 0; p < e.ports.size(); ++p) {
      if (!is_frame(e.ports[p].what)) continue;
      const bool rigid = p == 1 && e.ports.size() == 2 && e.rigid && e.ports[1].writes() && is_frame(e.ports[0].what) &&
                         has_constant_pose(e);
      if (!rigid || frames_.contains(e.names[p])) {
        frame(e.ports[p].what, e.names[p]);
        continue;
      }
      frames_.emplace(e.names[p], static_cast<int>(out_.picture.frames.size()));
      out_.picture.frames.push_back({e.names[p], -1, frames_.at(e.names[0]), constant_pose(e)});
    }
  }

  // ---- elements
  /// What its ports are connected to.
  struct connected {
    std::vector<int> frames, coordinates;
    int base = -1, end = -1;
    std::string names;
  };
  connected connections(const element_parts& e) {
    connected c;
    for (std::size_t p = 0; p < e.ports.size(); ++p) {
      c.names += (p == 0 ? "" : ", ") + e.names[p];
      if (is_coordinate(e.ports[p].what)) c.coordinates.push_back(coordinate(e.names[p]));
      if (!is_frame(e.ports[p].what)) continue;
      c.frames.push_back(frames_.at(e.names[p]));
      if (e.ports[p].how == access::out)
        c.end = c.frames.back();
      else if (c.base < 0)
        c.base = c.frames.back();
    }
    return c;
  }
  void add(const element_parts& e) {
    const auto k = kind_of_element(e.type);
    const auto c = connections(e);
    const bool moves = c.base >= 0 && c.end >= 0;
    if (k.as == drawn::base) return;
    if (k.as == drawn::pull) return out_.picture.pulls.push_back(c.frames[0]);
    if (k.as == drawn::joint || (k.as == drawn::unknown && e.rigid && moves && !c.coordinates.empty()))
      return add_joint(e, k, c);
    if (moves) return add_link(e, c.base, c.end);
    if (k.as == drawn::body && !c.frames.empty()) return add_body(e, c.frames[0]);
    auto& s = out_.picture;
    if (k.as == drawn::unknown)
      for (std::size_t i = 1; i < c.frames.size(); ++i) add_link(e, c.frames[0], c.frames[i]);
    s.forces.push_back({c.names, e.type, std::string(k.kind), c.frames, c.coordinates, element_});
    if (k.kind == "contact" && c.frames.size() == 2) contacts_.push_back({&e, c.frames[0], c.frames[1]});
    if (k.stem == "joint_limit" && !c.coordinates.empty()) narrow(s.coordinates[size(c.coordinates[0])], e);
  }
  void add_link(const element_parts& e, int from, int to) { out_.picture.links.push_back({e.type, from, to}); }
  void add_joint(const element_parts& e, const element_kind& k, const connected& c) {
    auto& s = out_.picture;
    scene::joint j{{}, e.type, std::string(k.kind), c.base, c.end, false, {}, c.coordinates};
    for (const int i : c.coordinates) j.name += (j.name.empty() ? "" : ", ") + s.coordinates[size(i)].name;
    if (k.as == drawn::joint && k.kind != "spherical" && k.kind != "free") {
      j.has_axis = true;
      j.axis = k.kind == "planar" ? placement_turned(e, {0, 0, 1})
                                  : placement_turned(e, vector_parameter(e, "axis", {0, 0, 1}));
    }
    for (const int i : c.coordinates) {
      auto& q = s.coordinates[size(i)];
      if (q.kind != "number") continue;
      const bool turns = k.kind == "revolute" || k.kind == "screw";
      if (turns || k.kind == "prismatic") {
        q.kind = std::string(turns ? "angle" : "length");
        q.unit = std::string(turns ? "rad" : "m");
      }
    }
    s.joints.push_back(std::move(j));
    if (k.kind != "free" && (is_placed(e) || k.kind == "prismatic" || k.kind == "planar" || k.as == drawn::unknown))
      add_link(e, c.base, c.end);
  }
  void add_body(const element_parts& e, int frame) {
    auto& s = out_.picture;
    auto b = body_of(e);
    b.name = s.frames[size(frame)].name, b.frame = frame;
    s.bodies.push_back(std::move(b));
  }
  /// By the stops of a joint.
  static void narrow(scene::coordinate& c, const element_parts& e) {
    c.lower = (std::max)(c.lower, number_parameter(e, "lower", -scene::none));
    c.upper = (std::min)(c.upper, number_parameter(e, "upper", scene::none));
  }
  void give_ranges() {
    for (auto& j : out_.picture.joints)
      if (j.coordinates.size() == 1) {
        const auto& c = out_.picture.coordinates[size(j.coordinates[0])];
        j.lower = c.lower, j.upper = c.upper;
      }
  }

  // ---- the model
  void add_model() {
    auto& s = out_.picture;
    const auto cannot = [&s](const std::string& why) {
      s.notes.push_back(why + ": the page plays, and does not simulate");
    };
    if (chain_.unrecorded) return cannot("a part of the chain is neither an element nor a chain");
    model_record m;
    m.gravity = {chain_.gravity.x, chain_.gravity.y, chain_.gravity.z};
    for (const auto& e : chain_.elements) {
      if (kind_of_element(e.type).as == drawn::pull) continue;
      if (kind_of_element(e.type).as == drawn::unknown)
        return cannot("'" + e.type + "' is not an element of the library");
      if (e.holds_code) return cannot("'" + e.type + "' holds a function of the program");
      auto& r = m.elements.emplace_back();
      r.type = e.type, r.parameters = e.parameters;
      for (std::size_t p = 0; p < e.ports.size(); ++p)
        r.connections.push_back({std::string(e.ports[p].role), e.names[p]});
    }
    try {
      s.model = model_json(m);
    } catch (const error& e) {
      cannot(std::string(e.what()).substr(5));
    }
  }

  static std::size_t size(int i) { return static_cast<std::size_t>(i); }

  const chain_parts& chain_;
  built_scene out_;
  std::vector<drawn_contact> contacts_;
  int element_ = 0;  ///< its number in the model
  std::array<std::unordered_map<std::string, int>, kinds> slots_;
  std::unordered_map<std::string, int> coordinates_, frames_;
};
}  // namespace

built_scene build_scene(const chain_parts& chain) { return scene_builder(chain).build(); }

}  // namespace kte::view
