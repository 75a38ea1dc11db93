#include <kte/io/dot.hpp>
#include <kte/io/program.hpp>
#include <kte/robots/detail/robot_findings.hpp>

#include <algorithm>
#include <unordered_map>

#include "commands.hpp"
#include "json_writer.hpp"
#include "message.hpp"
#include "recorded_scene.hpp"
#include "start.hpp"
#include "structure.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {

struct info_options {
  reading in;
  bool json = false, dot = false;
};

struct limits_of_one {
  double lower, upper, rate, effort;
};
/// The limits of a coordinate with one number.
limits_of_one limits(const mechanism& m, const structure::coordinate& c) {
  const auto v = static_cast<std::size_t>(c.v);
  const auto& l = m.robot.limits;
  return {l.lower[v], l.upper[v], l.rate[v], l.effort[v]};
}
bool is_free_number(const structure::coordinate& c) { return c.v >= 0 && c.nv == 1; }

/// "q1 in [-2.9, 2.9] rad, at most 1.5 rad/s, 320 Nm", "q2, which follows others".
std::string coordinate_text(const mechanism& m, const structure::coordinate& c) {
  std::string text = "'" + c.name + "'";
  if (!is_free_number(c)) return text + (c.v < 0 ? ", which follows others" : "");
  const auto l = limits(m, c);
  if (std::isfinite(l.lower) || std::isfinite(l.upper))
    text += " in [" + short_number(l.lower) + ", " + short_number(l.upper) + "] " + c.unit;
  std::string most;
  if (std::isfinite(l.rate)) most = short_number(l.rate) + " " + c.unit + "/s";
  if (std::isfinite(l.effort)) most += (most.empty() ? "" : ", ") + short_number(l.effort) + (c.turns ? " Nm" : " N");
  return text + (most.empty() ? "" : ", at most " + most);
}

/// The tree of frames: under each those that joints and links carry.
class tree_text {
 public:
  tree_text(const mechanism& m, const structure& s) : m_(m), s_(s), children_(s.frames.size()) {
    coordinates_.reserve(s.coordinates.size()), masses_.reserve(s.bodies.size());
    for (const auto& c : s.coordinates) coordinates_.emplace(c.name, &c);
    for (const auto& b : s.bodies) masses_[b.frame].push_back(b.mass);
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < s.frames.size(); ++i)
      (s.frames[i].parent < 0 ? roots : children_[static_cast<std::size_t>(s.frames[i].parent)]).push_back(i);
    for (const auto r : roots) {
      text_ += s.frames[r].name + bodies_at(r) + '\n';
      add_children(r);
    }
  }
  const std::string& text() const { return text_; }

 private:
  /// Depth first, without recursion: chains may be long.
  void add_children(std::size_t root) {
    struct level {
      std::size_t frame, next;
      std::string indent;
      bool cut = false;  ///< whether the beginning of the indent is left out, so that it does not grow with the depth
    };
    std::vector<level> open{{root, 0, ""}};
    while (!open.empty()) {
      auto& l = open.back();
      if (l.next == children_[l.frame].size()) {
        open.pop_back();
        continue;
      }
      const auto child = children_[l.frame][l.next++];
      const bool last = l.next == children_[l.frame].size();
      // An only child stays in the column of its parent, so that long chains do not run off the page.
      const bool alone = children_[l.frame].size() == 1;
      text_ += (l.cut ? "… " : "") + l.indent + (alone ? "↓ " : last ? "└ " : "├ ") + line_of(child) + '\n';
      std::string deeper = l.indent + (alone ? "" : last ? "  " : "│ ");
      const bool cut = l.cut || deeper.size() > 120;
      if (deeper.size() > 120) deeper.erase(0, deeper.find(' ') + (deeper[0] == ' ' ? 2 : 1));
      open.push_back({child, 0, std::move(deeper), cut});
    }
  }
  std::string line_of(std::size_t i) const {
    const auto& f = s_.frames[i];
    std::string text = f.name + bodies_at(i) + ": " + short_type(f.by);
    if (f.has_axis) text += " " + axis_text(f.axis);
    for (const auto& q : f.moved_by) text += " " + coordinate_text(m_, *coordinates_.at(q));
    return text;
  }
  static std::string axis_text(const kte::vec3<>& a) {
    const char* const names[]{"x", "y", "z"};
    const double numbers[]{a.x, a.y, a.z};
    for (int i = 0; i < 3; ++i)
      if (std::abs(numbers[i]) == 1) return (numbers[i] < 0 ? "-" : "") + std::string(names[i]);
    return short_vector(a);
  }
  std::string bodies_at(std::size_t i) const {
    std::string text;
    if (const auto at = masses_.find(s_.frames[i].name); at != masses_.end())
      for (const double mass : at->second) text += (text.empty() ? " [" : ", ") + short_number(mass) + " kg";
    return text.empty() ? text : text + "]";
  }

  const mechanism& m_;
  const structure& s_;
  std::vector<std::vector<std::size_t>> children_;
  std::unordered_map<std::string_view, const structure::coordinate*> coordinates_;
  std::unordered_map<std::string_view, std::vector<double>> masses_;  ///< by frame
  std::string text_;
};

/// Where the coordinates stand in tables, in words, if any stands elsewhere than in q and v of the chain.
std::unordered_map<std::string, std::string> columns_of(const mechanism& m) {
  std::unordered_map<std::string, std::string> all;
  const auto layout = kte::layout(m.chain());
  const auto order = coordinates_of(m, m.chain());
  const auto same = [](const auto& e, const std::string& name) { return e.name == name; };
  if (std::equal(layout.begin(), layout.end(), order.begin(), order.end(), same)) return all;
  std::unordered_map<std::string_view, kte::layout_entry<std::string>> places;
  for (const auto& e : layout) places.emplace(e.name, e);
  int q = 0, v = 0;
  const auto range = [](const char* of, int first, int count) {
    return of + std::to_string(first) + (count > 1 ? ".." + std::to_string(first + count - 1) : "");
  };
  for (const auto& name : order) {
    const auto& e = places.at(name);
    all[name] = "; in tables " + range("q_", q, e.nq) + ", " + range("v_", v, e.nv);
    q += e.nq, v += e.nv;
  }
  return all;
}

std::string text_of(const mechanism& m, const structure& s) {
  const auto& g = m.chain().gravity();
  std::string t = printable(m.file) + " (" + m.format + "): '" + m.robot.name + "'\n";
  t += degrees_text(m.chain().dofs()) + ", " + counted(static_cast<std::size_t>(m.chain().nq()), "number") + " in q; " +
       bodies_text(s.bodies.size()) + " of " + short_number(s.mass) + " kg; " + counted(s.frames.size(), "frame") +
       "; " + size_text(s.size) + "; gravity " + short_vector(g) + " m/s^2\n\n";
  t += tree_text(m, s).text();
  const auto centred = [](const structure::body& b) {
    return short_number(b.mass) + " kg at " + short_vector(b.centre) + " m, moments " + short_number(b.moments[0]) +
           ", " + short_number(b.moments[1]) + ", " + short_number(b.moments[2]) + " kg m^2";
  };
  if (!s.bodies.empty()) t += "\nbodies, in axes of their frames\n";
  for (const auto& b : s.bodies) t += "  " + b.frame + ": " + centred(b) + '\n';
  if (!s.coordinates.empty()) t += "\ncoordinates\n";
  const auto columns = columns_of(m);
  for (const auto& c : s.coordinates) {
    t += "  " + coordinate_text(m, c);
    if (c.v >= 0 && c.nv > 1) t += ", a " + c.kind;
    if (c.v >= 0)
      t += ": q[" + std::to_string(c.q) + (c.nq > 1 ? ".." + std::to_string(c.q + c.nq - 1) : "") + "], v[" +
           std::to_string(c.v) + (c.nv > 1 ? ".." + std::to_string(c.v + c.nv - 1) : "") + "]";
    if (const auto at = columns.find(c.name); at != columns.end()) t += at->second;
    t += '\n';
  }
  if (!s.inputs.empty()) t += "\ninputs\n";
  for (const auto& name : s.inputs) t += "  " + name + '\n';
  if (const auto loops = kte::detail::loop_findings(m.robot); !loops.empty()) {
    t += '\n' + loops.front() + '\n';
    for (std::size_t i = 1; i < loops.size(); ++i) t += "  " + loops[i] + '\n';
  }
  if (!s.others.empty()) t += "\nother elements\n";
  for (const auto& e : s.others) t += "  " + e.text + '\n';
  if (!m.robot.configurations.empty()) t += "\nconfigurations with names\n";
  for (const auto& c : m.robot.configurations) t += "  " + c.name + '\n';
  if (!m.robot.shapes.empty()) {
    const auto solid =
        std::count_if(m.robot.shapes.begin(), m.robot.shapes.end(), [](const auto& x) { return x.collision; });
    t += "\n" + counted(m.robot.shapes.size() - static_cast<std::size_t>(solid), "shape") + " to see, " +
         std::to_string(solid) + " to collide with\n";
  }
  for (const auto& note : meshes_not_drawn(m)) t += "  " + note + '\n';
  if (const auto n = texts_of(m.robot.not_read, "").size())
    t += "\n" + counted(n, "thing") + " of the file not read: kte check " + printable(m.file) + '\n';
  return t;
}

std::vector<double> numbers(const kte::vec3<>& x) { return {x.x, x.y, x.z}; }

std::string json_of(const mechanism& m, const structure& s) {
  json_writer j;
  j.object().member("file", m.file).member("format", m.format).member("name", m.robot.name);
  j.member("gravity", numbers(m.chain().gravity())).member("nq", m.chain().nq()).member("nv", m.chain().dofs());
  j.member("mass", s.mass).member("size", s.size);
  j.key("coordinates").list();
  for (const auto& c : s.coordinates) {
    j.object().member("name", c.name).member("kind", c.kind).member("unit", c.unit).member("follows", c.v < 0);
    if (c.v >= 0) j.member("q", c.q).member("nq", c.nq).member("v", c.v).member("nv", c.nv);
    if (is_free_number(c)) {
      const auto l = limits(m, c);
      j.member("lower", l.lower).member("upper", l.upper).member("rate", l.rate).member("effort", l.effort);
    }
    j.end();
  }
  j.end().key("frames").list();
  for (const auto& f : s.frames) {
    j.object().member("name", f.name).member("planar", f.planar).key("parent");
    f.parent < 0 ? j.value(std::nan("")) : j.value(s.frames[static_cast<std::size_t>(f.parent)].name);
    j.member("by", f.by).member("coordinates", f.moved_by).member("position", numbers(f.position));
    j.key("rotation").list().value(numbers(f.rotation.x)).value(numbers(f.rotation.y)).value(numbers(f.rotation.z));
    j.end().end();
  }
  j.end().key("bodies").list();
  for (const auto& b : s.bodies) {
    const auto& i = b.inertia;
    j.object().member("frame", b.frame).member("mass", b.mass).member("centre", numbers(b.centre));
    j.member("inertia", std::vector{i.xx, i.xy, i.xz, i.yy, i.yz, i.zz}).member("moments", b.moments).end();
  }
  j.end().key("elements").list();
  for (const auto& e : s.others) j.object().member("type", e.type).member("text", e.text).end();
  j.end().member("inputs", s.inputs).key("configurations").list();
  for (const auto& c : m.robot.configurations) j.object().member("name", c.name).member("q", c.q).end();
  j.end().member("meshes_not_drawn", meshes_not_drawn(m));
  return j.end().text();
}

/// Loops closed, if they can be.
Eigen::VectorXd shown_configuration(const mechanism& m) {
  try {
    return initial_state({}, m, m.chain()).q;
  } catch (const kte::error& e) {
    say(m.file + ": " + std::string(e.what()).substr(5));
    return kte::neutral_configuration(m.chain());
  }
}

int info(const info_options& o) {
  if (o.json && o.dot) throw usage_error("--json and --dot exclude each other");
  const auto m = read_and_warn(o.in);
  if (o.dot) {
    kte::detail::write_standard_output(kte::to_dot(m.chain()));
    return 0;
  }
  const structure s(m.robot, shown_configuration(m));
  kte::detail::write_standard_output(o.json ? json_of(m, s) : printable_lines(text_of(m, s)));
  return 0;
}

}  // namespace

void add_info(command_line& line) {
  const auto o = std::make_shared<info_options>();
  add_reading(line.add("info", "shows its tree of frames, masses and limits",
                       "Shows a mechanism: the tree of its frames with joints and coordinate limits, the bodies, the "
                       "positions of coordinates in q and v, inputs, and elements that are neither joints nor bodies."),
              o->in)
      .flag("--dot", o->dot, "prints the graph of its elements for Graphviz")
      .flag("--json", o->json,
            "prints JSON, with the poses of frames at the neutral configuration, or where loops close")
      .runs([o] { return info(*o); });
}

}  // namespace kte_tool
