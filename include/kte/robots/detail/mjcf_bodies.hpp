#pragma once

#include <kte/robots/detail/free_names.hpp>
#include <kte/robots/detail/mjcf_actuator.hpp>
#include <kte/robots/detail/mjcf_contact.hpp>
#include <kte/robots/detail/mjcf_equality.hpp>
#include <kte/robots/detail/mjcf_height_field.hpp>
#include <kte/robots/detail/mjcf_joint.hpp>
#include <kte/robots/detail/mjcf_keyframe.hpp>
#include <kte/robots/detail/mjcf_masses.hpp>
#include <kte/robots/detail/mjcf_materials.hpp>
#include <kte/robots/detail/mjcf_mesh.hpp>
#include <kte/robots/detail/mjcf_options.hpp>

#include <unordered_map>
#include <unordered_set>

namespace kte::detail {

/// Reads the links and joints of a file in MJCF. The world is a link; a body without joints is fixed to its parent.
class mjcf_bodies {
 public:
  mjcf_bodies(robot_description& d, const robot_options& o, xml_parser parse)
      : d_(d), contacts_(o.contacts.requested()), tree_(d, o, parse), unread_(contacts_), equality_(d) {}

  void read(xml_node file) {
    auto& top = tree_.top(std::move(file));
    const xml_item root(top.root, d_);
    d_.name = root.text_or("model", "");
    root.only({"compiler", "default", "worldbody", "actuator", "option", "asset", "keyframe", "equality", "tendon",
               "contact", "deformable"},
              {"model"});
    collect_names(top.root);
    d_.links.emplace_back().name = "world";
    equality_.stands.emplace_back();
    for (const auto& w : root.children("worldbody")) {
      if (d_.links[0].line == 0) d_.links[0].line = w.line(), d_.links[0].file = w.file();
      w.only({"geom", "body", "site", "frame", "replicate", "attach", "inertial"}, {"name", "childclass"});
      contents(tree_.children(w, {&top, {}, w.text_or("childclass", "")}), here{0, true, false});
    }
    apply_mass_rules(top.settings.masses(), d_, bodies_);
    read_mjcf_options(root, d_, unread_);
    for (const auto& j : d_.joints) joints_.insert(j.name);
    sections(root, {&top});
    for (const auto& a : tree_.attached()) sections({a.model->root, d_}, a);
    for (const auto& m : tree_.models())
      for (const auto& x : xml_item(m.root, d_).children("asset")) unread_.assets(x, m.settings.classes());
    name_frames();
    add_reference();
    for (const auto& k : root.children("keyframe"))
      for (const auto& x : k.children("key")) read_mjcf_keyframe(x, d_);
    equality_.finish();
    unread_.finish();
    contact_leftovers_.warn();
  }

 private:
  using kind = robot_joint::kind;

  /// The current link: whether it is fixed to the world, and whether geoms determine its mass.
  struct here {
    std::size_t link;
    bool fixed, weighs;
  };

  /// Collects the names in the file, so that elements without a name get unused ones.
  void collect_names(const xml_node& n) {
    for (const auto& [key, value] : n.attributes)
      if (key == "name" && (n.name == "body" || n.name == "joint" || n.name == "freejoint")) names_.take(value);
    for (const auto& c : n.children) collect_names(c);
  }

  /// Reads the sites, geoms and bodies of a body or of the world.
  void contents(const std::vector<mjcf_child>& all, const here& at) {
    for (const auto& c : all) {
      if (c.x.name() == "geom") geom(c, at);
      if (c.x.name() == "site") site(c, at.link);
      if (c.x.name() == "body") body(c, at);
      if (c.x.name() == "plugin") c.x.moves_differently("plugins are not modelled");
    }
  }
  void body(const mjcf_child& c, const here& above) {
    look_for_interruption();
    if (++depth_ > 1000) c.x.fail("bodies nest deeper than 1000");
    const auto& settings = c.in.model->settings;
    const auto x = settings.classes().cleaned(c.x);
    x.only({"inertial", "joint", "freejoint", "geom", "body", "site", "frame", "replicate", "attach", "plugin"},
           {"name", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "childclass", "gravcomp", "mocap"});
    mjcf_scope in{c.in.model, {}, x.text_or("childclass", c.in.around.c_str()), c.in.prefix, c.in.suffix, c.in.copied};
    if (!in.around.empty() && !settings.classes().has(in.around))
      x.fail("there is no default class '" + excerpt(in.around) + "'");
    const auto place = settings.place(x);
    if (settings.in_world()) {
      if (!x.has("pos")) x.fail("has no pos: coordinate='global' is read where bodies have one");
      in.place = inverse_of(place);
    }
    if (keyword(x, "mocap", {"false", "true"}) == "true") x.not_read("mocap is not read: it stands still");
    const std::size_t index = d_.links.size();
    bodies_.push_back(index);
    auto& l = d_.links.emplace_back();
    equality_.stands.push_back(equality_.stands[above.link] * (c.in.place * place));
    l.name = x.has("name") ? c.in.named(x.text("name")) : names_.fresh("body" + std::to_string(index));
    l.line = x.line(), l.file = x.file();
    l.gravity_compensation = x.number_or("gravcomp", 0);
    std::vector<mjcf_child> moving;
    const mjcf_child* inertial = nullptr;
    const auto all = tree_.children(x, in);
    for (const auto& y : all) {
      if (y.x.name() == "joint" || y.x.name() == "freejoint") moving.push_back(y);
      if (y.x.name() != "inertial") continue;
      if (inertial != nullptr) y.x.fail("occurs twice");
      inertial = &y;
    }
    const here at{index, above.fixed && moving.empty(), settings.from_geoms(inertial != nullptr)};
    const auto weigh = [&] {
      d_.links[index].inertial = moved_body(inertial->in.place, read_mjcf_inertial(settings, inertial->x));
    };
    if (inertial != nullptr && !at.weighs) weigh();
    const auto own = l.name;
    joints(moving, x, c.in.place * place, d_.links[above.link].name, own);
    contents(all, at);
    if (inertial != nullptr && !d_.links[index].inertial) weigh();  // no geom counts
    --depth_;
  }

  void geom(const mjcf_child& c, const here& at) {
    const auto& settings = c.in.model->settings;
    const auto x = settings.classes().resolved(c.x, c.in.around);
    x.only({}, {"name",     "class",  "type",   "pos",    "quat",     "axisangle", "euler",       "xyaxes",
                "zaxis",    "size",   "fromto", "mass",   "density",  "mesh",      "rgba",        "material",
                "contype",  "group",  "solmix", "solref", "solimp",   "fitscale",  "conaffinity", "shellinertia",
                "friction", "margin", "gap",    "condim", "priority", "hfield"});
    auto g = read_geom(x, c.in);
    const int group = x.whole_or("group", 0);
    const bool wants_mass = at.weighs && settings.counts(group);
    const bool by_mesh = x.has("mesh") || g.shape.is == robot_shape::form::mesh;
    std::optional<rigid_body<>> b;
    if (by_mesh)
      b = mesh(x, c.in, g, wants_mass, at.fixed);
    else if (wants_mass)
      b = body_of_geom(x, g);
    auto& l = d_.links[at.link];
    if (b && wants_mass && settings.discards_visuals() && !g.collides)
      x.moves_differently("its mass counts, whatever discardvisual says");
    if (b && wants_mass) {
      const auto placed = moved_body(c.in.place, *b);
      l.inertial = l.inertial ? together(*l.inertial, placed) : placed;
    }
    g.shape.origin = c.in.place * g.shape.origin;
    contact(x, *c.in.model, g);
    if (g.shape.rgba.empty()) g.shape.rgba = materials_.rgba(g.shape.material, *c.in.model);
    const bool seen = !g.collides || group < 3;  // viewers show groups up to 2
    if (seen) l.visuals.push_back(g.shape);
    if (g.collides) l.collisions.push_back(g.shape);
  }

  /// Reads how a geom touches others, if contacts are requested.
  void contact(const xml_item& x, mjcf_model& model, mjcf_geom& g) {
    if (!contacts_) {
      if (x.has("hfield")) x.not_read("its hfield is not read");
      return unread_.contact_of(x, g.collides);
    }
    g.shape.touch = read_mjcf_touch(x, contact_leftovers_);
    if (x.text_or("type", "") == "hfield") read_mjcf_height_field(x, model, g.shape);
  }

  /// Describes a geom with a mesh, whose file is read where its mass or its sizes are needed.
  std::optional<rigid_body<>> mesh(const xml_item& x, const mjcf_scope& in, mjcf_geom& g, bool weighs, bool fixed) {
    meshes_.describe(x, *in.model, g.shape);
    const bool fitted = g.shape.is != robot_shape::form::mesh;
    const auto& o = in.model->settings.options();
    const bool massless = x.has("mass") ? x.number("mass") == 0 : x.number_or("density", 1000) == 0;
    const bool stands = fixed && !o.floating_base && o.root.empty() && !(in.model->settings.masses().total > 0);
    if (!weighs || massless || stands) {
      if (fitted) g.shape.is = robot_shape::form::mesh, g.shape.origin = in.model->settings.place(x);
      return {};
    }
    if (!fitted) return moved_body(g.shape.origin, meshes_.body(x, *in.model));
    meshes_.fit(x, in, g);
    return body_of_geom(x, g);
  }

  void site(const mjcf_child& c, std::size_t link) {
    const auto& settings = c.in.model->settings;
    const auto x = settings.classes().resolved(c.x, c.in.around);
    unread_.site(x);
    if (!x.has("name")) return;
    const auto place = x.has("fromto") ? read_geom(x, c.in).shape.origin : settings.place(x);
    d_.frames.push_back({c.in.named(x.text("name")), x.line(), d_.links[link].name, c.in.place * place});
  }
  /// Names the frames of sites; sites may have the names of bodies, frames may not.
  void name_frames() {
    std::unordered_set<std::string> names;
    for (const auto& l : d_.links) names.insert(l.name);
    std::unordered_map<std::string, std::size_t> copies;
    for (auto& f : d_.frames) {
      if (names.insert(f.name).second) continue;
      const auto old = f.name;
      for (std::size_t& k = copies[old]; !names.insert(f.name).second; ++k)
        f.name = old + ".site" + (k == 0 ? "" : std::to_string(k + 1));
      d_.not_read.push_back({f.line, "site '" + old + "': its frame is '" + f.name + "', as a body has its name"});
    }
  }

  /// Reads the joints of one body, which act one after another, with massless links between them.
  void joints(const std::vector<mjcf_child>& all, const xml_item& x, robot_pose place, const std::string& parent,
              const std::string& own) {
    if (all.empty()) {
      robot_joint j;
      j.name = names_.fresh(own + "_fixed"), j.line = x.line(), j.file = x.file();
      j.parent = parent, j.child = own, j.origin = place;
      d_.joints.push_back(std::move(j));
    }
    std::string from = parent;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto& c = all[i];
      const auto y = c.x.name() == "freejoint" ? c.in.model->settings.classes().cleaned(c.x)
                                               : c.in.model->settings.classes().resolved(c.x, c.in.around);
      const bool last = i + 1 == all.size();
      auto j = read_mjcf_joint(
          y, c.in, y.has("name") ? "" : names_.fresh(own + "_joint" + (i == 0 ? "" : std::to_string(i + 1))));
      j.parent = from, j.child = last ? own : names_.fresh(own + "." + std::to_string(i + 1));
      if (j.is == kind::floating) {
        if (all.size() > 1 || parent != "world") y.fail("a free joint must be the only one of a body in the world");
        if (!is_nothing(place)) y.not_read("the pose of its body is where it starts, which is not part of a chain");
      } else {
        j.origin = place * j.origin;
      }
      if (!last) {
        auto& between = d_.links.emplace_back();
        equality_.stands.push_back(equality_.stands.back());
        between.name = j.child, between.line = j.line, between.file = j.file;
      }
      from = j.child, place = {};
      d_.joints.push_back(std::move(j));
    }
  }

  /// The configuration in which the file puts the bodies, and in which <connect> and <weld> are closed, if that is not
  /// q = 0.
  void add_reference() {
    const auto moved = [](const robot_joint& j) { return j.reference != 0 || j.is == kind::floating; };
    if ((d_.closures.empty() && !contacts_) || std::none_of(d_.joints.begin(), d_.joints.end(), moved)) return;
    robot_configuration c{"reference", 0, {}};
    std::unordered_map<std::string_view, std::size_t> links;
    for (std::size_t i = 0; i < d_.links.size(); ++i) links.emplace(d_.links[i].name, i);
    for (const auto& j : d_.joints)
      if (j.is == kind::floating) {
        const auto& at = equality_.stands[links.at(j.child)];
        const auto r = to_quaternion(at.rotation);
        c.joints.emplace_back(j.name, std::vector{at.position.x, at.position.y, at.position.z, r.w, r.x, r.y, r.z});
      } else if (has_one_coordinate(j)) {
        c.joints.emplace_back(j.name, std::vector{j.reference});
      }
    d_.configurations.push_back(std::move(c));
  }

  /// Reads the actuators of a model and of the models that it attaches, and notes the contents that are not read.
  void sections(const xml_item& root, const mjcf_scope& in) {
    for (const auto& x : root.children()) {
      const auto n = x.name();
      if (n == "contact" && contacts_ && !unread_.contact_is_off()) {
        for (const auto& c : x.children())
          if (c.name() == "pair" || c.name() == "exclude")
            d_.contact_pairs.push_back(
                read_mjcf_pair(in.model->settings.classes().resolved(c, ""), in, contact_leftovers_));
          else
            c.not_read("not read");
      } else if (n == "contact" || n == "tendon" || n == "deformable")
        unread_.section(x, in.model->settings.classes());
      if (n == "equality")
        for (const auto& e : x.children()) {
          const auto whole = in.model->settings.classes().resolved(e, "", "equality");
          if (!unread_.constraint(whole) && !equality_.read(whole, in))
            whole.moves_differently("this constraint is not modelled");
        }
      if (n == "actuator")
        for (const auto& a : x.children()) actuator(in.model->settings.classes().resolved(a, ""), in);
    }
  }
  void actuator(const xml_item& x, const mjcf_scope& in) {
    if (!in.prefix.empty() && x.has("joint") && !joints_.contains(in.named(x.text("joint")))) return;
    auto a = read_mjcf_actuator(x, in);
    if (!a.joint.empty() && !joints_.contains(a.joint))
      return x.moves_differently("there is no joint '" + excerpt(a.joint) + "' for it: it is not read");
    const auto& law = a.law;
    const bool pulls = law.offset != 0 || law.stiffness != 0 || law.damping != 0;
    if (!a.not_modelled.empty() || (pulls && a.joint.empty()))
      unread_.actuator(x);
    else if (pulls)
      unread_.servo(x);
    if (a.joint.empty()) return x.not_read("acts on no joint, and is not read");
    d_.actuators.push_back(std::move(a));
  }

  robot_description& d_;
  bool contacts_;  ///< whether contacts are requested
  mjcf_tree tree_;
  mjcf_unread unread_;
  contact_leftovers contact_leftovers_;
  mjcf_meshes meshes_;
  mjcf_materials materials_;
  mjcf_equality equality_;
  std::vector<std::size_t> bodies_;  ///< the links of bodies in the file
  free_names names_;
  std::unordered_set<std::string> joints_;
  int depth_ = 0;
};

}  // namespace kte::detail
