#include <bit>

#include "json_text.hpp"
#include "scene_checks.hpp"

namespace kte {

namespace {
static_assert(std::endian::native == std::endian::little, "kte: numbers in scenes are written as they are in memory");

class scene_writer {
 public:
  explicit scene_writer(const scene& s) : s_(s) {}

  std::string write() {
    out_.open_object();
    text("format", "kte-scene-1"), text("title", s_.title);
    number("dimension", s_.dimension), list("gravity", s_.gravity), number("size", s_.size);
    each("frames", s_.frames, [this](const scene::frame& f) { frame(f); });
    number("tracks", s_.tracks);
    each("coordinates", s_.coordinates, [this](const scene::coordinate& c) { coordinate(c); });
    each("joints", s_.joints, [this](const scene::joint& j) { joint(j); });
    each("links", s_.links,
         [this](const scene::link& l) { text("type", l.type), number("from", l.from), number("to", l.to); });
    each("bodies", s_.bodies, [this](const scene::body& b) { body(b); });
    each("forces", s_.forces, [this](const scene::force& f) {
      text("type", f.type), text("kind", f.kind), text("name", f.name);
      list("frames", f.frames), list("coordinates", f.coordinates), number("element", f.element);
    });
    out_.key("pulls"), out_.list(s_.pulls);
    each("shapes", s_.shapes, [this](const scene::shape& x) { shape(x); });
    each("meshes", s_.meshes, [this](const scene::mesh& m) {
      text("name", m.name), base64("positions", m.positions), base64("indices", m.indices);
    });
    texts("notes", s_.notes);
    each("recordings", s_.recordings, [this](const scene::recording& r) { recording(r); });
    out_.key("model");
    s_.model.empty() ? out_.null() : out_.text(s_.model);
    out_.key("state"), out_.open_object();
    list("q", s_.q), list("v", s_.v);
    out_.close_object();
    out_.close_object();
    return std::move(out_.out());
  }

 private:
  void frame(const scene::frame& f) {
    text("name", f.name);
    if (f.track >= 0) return number("track", f.track);
    number("parent", f.parent), list("pose", f.place);
  }
  void coordinate(const scene::coordinate& c) {
    text("name", c.name), text("unit", c.unit), text("kind", c.kind);
    number("q", c.q), number("size", c.size), number("v", c.v), number("v_size", c.v_size);
    number("lower", c.lower), number("upper", c.upper);
    out_.key("follows"), out_.boolean(c.follows);
  }
  void joint(const scene::joint& j) {
    text("name", j.name), text("type", j.type), text("kind", j.kind);
    number("before", j.before), number("after", j.after);
    out_.key("axis");
    j.has_axis ? out_.list(j.axis) : out_.null();
    list("coordinates", j.coordinates), number("lower", j.lower), number("upper", j.upper);
  }
  void body(const scene::body& b) {
    text("name", b.name), number("frame", b.frame), number("mass", b.mass);
    list("centre", b.centre), list("orientation", b.orientation), list("ellipsoid", b.ellipsoid);
  }
  void shape(const scene::shape& x) {
    number("frame", x.frame), list("pose", x.place), text("type", x.type), list("size", x.size);
    out_.key("colour");
    x.colour.empty() ? out_.null() : out_.list(x.colour);
    text("role", x.contact ? "contact" : x.collision ? "collision" : "visual");
    out_.key("mesh");
    x.mesh < 0 ? out_.null() : out_.number(x.mesh);
  }
  void recording(const scene::recording& r) {
    text("name", r.name), number("count", r.t.size());
    base64("t", r.t), base64("positions", r.positions), base64("rotations", r.rotations);
    known("q", r.q), known("v", r.v), known("signals", r.signals);
    each("columns", r.columns,
         [this](const scene::column& c) { text("name", c.name), text("unit", c.unit), base64("data", c.data); });
    texts("plotted", r.plotted);
  }

  /// Numbers, or null for an empty list.
  void known(std::string_view key, const std::vector<float>& x) {
    if (!x.empty()) return base64(key, x);
    out_.key(key), out_.null();
  }
  template <class List, class Write>
  void each(std::string_view key, const List& all, const Write& write) {
    out_.key(key), out_.open_list();
    for (const auto& x : all) {
      out_.open_object();
      write(x);
      out_.close_object();
    }
    out_.close_list();
  }
  void text(std::string_view key, std::string_view x) { out_.key(key), out_.text(x); }
  void texts(std::string_view key, const std::vector<std::string>& all) {
    out_.key(key), out_.open_list();
    for (const auto& x : all) out_.text(x);
    out_.close_list();
  }
  void number(std::string_view key, auto x) { out_.key(key), out_.number(x); }
  template <class List>
  void list(std::string_view key, const List& x) {
    out_.key(key), out_.list(x);
  }
  template <class Number>
  void base64(std::string_view key, const std::vector<Number>& x) {
    out_.key(key), out_.numbers_in_base64(std::span<const Number>(x));
  }

  const scene& s_;
  view::json_text out_;
};
}  // namespace

std::string to_json(const scene& s) {
  view::check(s);
  return scene_writer(s).write();
}

}  // namespace kte
