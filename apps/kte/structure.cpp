#include "structure.hpp"

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/math/principal_moments.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/runtime_chain/layout.hpp>

#include <algorithm>
#include <unordered_map>

#include "shape_extent.hpp"

namespace kte_tool {

namespace {

const std::vector<double>* parameter(const kte::element_record& r, std::string_view name) {
  for (const auto& p : r.parameters)
    if (p.name == name) return &p.values;
  return nullptr;
}
kte::vec3<> vector_of(const kte::element_record& r, std::string_view name) {
  const auto* const x = parameter(r, name);
  return x && x->size() == 3 ? kte::vec3<>{(*x)[0], (*x)[1], (*x)[2]} : kte::vec3<>{};
}

/// Fills a structure, element by element.
class structure_reader {
 public:
  structure_reader(const kte::robot& r, const Eigen::VectorXd& q, structure& out) : out_(out) {
    const auto& chain = r.chain;
    const auto frames = static_cast<std::size_t>(chain.wiring().count(kte::kind::frame_3D));
    frames_.reserve(frames), out_.frames.reserve(frames);
    chain.for_each_element([this](const kte::kte_element& e) { add(e); });
    for (const auto& e : kte::layout(chain)) {
      auto& c = coordinate(e.name, e.what);
      c.q = e.q, c.nq = e.nq, c.v = e.v, c.nv = e.nv;
    }
    coordinates_.clear();
    std::stable_sort(out_.coordinates.begin(), out_.coordinates.end(), [](const auto& a, const auto& b) {
      return static_cast<unsigned>(a.v) < static_cast<unsigned>(b.v);  // followers last
    });
    const auto& t = chain.wiring();
    for (const auto& s : t.signals)
      if (s.u >= 0) out_.inputs.push_back(t.names[static_cast<std::size_t>(s.what)][static_cast<std::size_t>(s.slot)]);
    place(chain, q);
    measure(r.shapes);
  }

 private:
  structure::coordinate& coordinate(const std::string& name, kte::kind k) {
    const auto [at, fresh] = coordinates_.emplace(name, out_.coordinates.size());
    if (!fresh) return out_.coordinates[at->second];
    auto& c = out_.coordinates.emplace_back();
    c.name = name, c.kind = kte::to_string(k);
    return c;
  }
  int frame(const std::string& name, kte::kind k) {
    const auto [at, fresh] = frames_.emplace(name, static_cast<int>(out_.frames.size()));
    if (fresh) {
      out_.frames.emplace_back();
      out_.frames.back().name = name, out_.frames.back().planar = k == kte::kind::frame_2D;
    }
    return at->second;
  }
  void add(const kte::kte_element& e) {
    const auto ports = e.ports();
    const auto names = e.names();
    const std::string type(e.type());
    int base = -1;
    bool is_joint = false;
    for (std::size_t p = 0; p < ports.size(); ++p) {
      if (!kte::is_frame(ports[p].what)) continue;
      const int f = frame(names[p], ports[p].what);
      if (ports[p].how != kte::access::out) {
        if (base < 0) base = f;
        continue;
      }
      is_joint = base >= 0;
      if (is_joint) connect(e, f, base);
    }
    if (is_joint) return;
    for (std::size_t p = 0; p < ports.size(); ++p)
      if (kte::is_coordinate(ports[p].what)) coordinate(names[p], ports[p].what);
    if (type == "inertia_3D" || type == "inertia_2D")
      add_body(e.record(), names[0]);
    else
      out_.others.push_back({type, kte::describe_element(e)});
  }
  void connect(const kte::kte_element& e, int end, int base) {
    auto& f = out_.frames[static_cast<std::size_t>(end)];
    f.parent = base, f.by = e.type();
    for (std::size_t p = 0; p < e.ports().size(); ++p) {
      if (!kte::is_coordinate(e.ports()[p].what)) continue;
      f.moved_by.push_back(e.names()[p]);
      auto& c = coordinate(e.names()[p], e.ports()[p].what);
      c.moves.push_back(f.by);
      if (e.ports()[p].what != kte::kind::gen) continue;
      c.turns = e.ports()[p].how == kte::access::angle;
      c.unit = c.turns ? "rad" : "m";
    }
    if (f.by.starts_with("rigid_link")) return;
    const auto record = e.holds_code() ? kte::element_record{} : e.record();
    f.has_axis = parameter(record, "axis") != nullptr, f.axis = vector_of(record, "axis");
  }
  void add_body(const kte::element_record& r, const std::string& name) {
    auto& b = out_.bodies.emplace_back();
    b.frame = name;
    b.mass = parameter(r, "mass")->at(0), b.centre = vector_of(r, "com");
    const auto& i = *parameter(r, "inertia");
    b.inertia = {i.at(0), i.at(1), i.at(2), i.at(3), i.at(4), i.at(5)};
    b.moments = kte::principal_moments(b.inertia);
    std::sort(b.moments.begin(), b.moments.end());
    b.as_published = parameter(r, "as_published") != nullptr;
    out_.mass += b.mass;
  }
  void place(const kte::runtime_chain& chain, const Eigen::VectorXd& q) {
    auto s = chain.make_state();
    kte::set_positions(s, q);
    kte::forward_kinematics(chain, s);
    for (auto& f : out_.frames) {
      if (f.planar) {
        const auto& x = s.frame_2D(f.name);
        f.position = {x.position.x, x.position.y, 0};
        f.rotation = {{x.rotation.cos, -x.rotation.sin, 0}, {x.rotation.sin, x.rotation.cos, 0}, {0, 0, 1}};
      } else {
        const auto& x = s.frame_3D(f.name);
        f.position = x.position, f.rotation = x.rotation;
      }
    }
  }
  /// Whether joints move the frames in the world. A frame follows its parent in the list.
  std::vector<bool> moving_frames() const {
    std::vector<bool> moves;
    for (const auto& f : out_.frames)
      moves.push_back(!f.moved_by.empty() || (f.parent >= 0 && moves[static_cast<std::size_t>(f.parent)]));
    return moves;
  }
  void measure(const std::vector<kte::robot::shape>& shapes) {
    constexpr double far = std::numeric_limits<double>::infinity();
    kte::vec3<> low{far, far, far}, high{-far, -far, -far};
    const auto reach = [&](const kte::vec3<>& p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    };
    for (const auto& f : out_.frames) reach(f.position);
    for (const auto& b : out_.bodies) {
      const auto& f = out_.frames[static_cast<std::size_t>(frames_.at(b.frame))];
      reach(f.position + f.rotation * b.centre);
    }
    const auto frame_of = [this](const kte::robot::shape& s) {
      const auto at = frames_.find(s.frame);
      return at == frames_.end() ? -1 : at->second;
    };
    const auto moving = moving_frames();
    const auto moves = [&moving](int frame) { return frame >= 0 && moving[static_cast<std::size_t>(frame)]; };
    const bool some_move = std::any_of(shapes.begin(), shapes.end(), [&](const auto& s) { return moves(frame_of(s)); });
    for (const auto& s : shapes) {
      const int at = frame_of(s);
      if (at < 0 || moves(at) != some_move) continue;
      const auto& f = out_.frames[static_cast<std::size_t>(at)];
      const auto turn = f.rotation * s.origin.rotation;
      const auto x = half_extent(s, turn.x), y = half_extent(s, turn.y), z = half_extent(s, turn.z);
      if (!x || !y || !z) continue;
      const kte::vec3<> centre = f.position + f.rotation * s.origin.position, half{*x, *y, *z};
      reach(centre - half), reach(centre + half);
    }
    const kte::vec3<> way = high - low;
    out_.size = out_.frames.empty() ? 0 : std::sqrt(dot(way, way));
  }

  structure& out_;
  std::unordered_map<std::string, int> frames_;
  std::unordered_map<std::string, std::size_t> coordinates_;
};

}  // namespace

structure::structure(const kte::robot& r) : structure(r, kte::neutral_configuration(r.chain)) {}
structure::structure(const kte::robot& r, const Eigen::VectorXd& q) { structure_reader(r, q, *this); }

std::string short_type(const std::string& type) {
  if (type.starts_with("rigid_link")) return "fixed";
  const auto end = type.find("_joint");
  return type.substr(0, std::min(end, type.size()));
}

}  // namespace kte_tool
