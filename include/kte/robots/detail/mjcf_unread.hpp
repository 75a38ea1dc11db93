#pragma once

#include <kte/robots/detail/mjcf_tree.hpp>

namespace kte::detail {

/// Notes the contents of a file in MJCF other than bodies and joints: a warning for each that moves a robot and is not
/// modelled, or one for all of a kind; the rest is listed.
class mjcf_unread {
 public:
  /// `contacts`: whether contacts are read.
  explicit mjcf_unread(bool contacts) : contacts_are_read_(contacts) {}

  /// Notes contact, which is not modelled, with one warning for all.
  void contact_of(const xml_item& geom, bool collides) {
    if (!collides) return;
    for (const auto* name : {"friction", "solref", "solimp", "solmix", "margin", "gap", "condim", "priority"})
      if (geom.has(name)) return note_contact(geom);
  }
  void option(const xml_item& x) {
    for (const auto* name : {"density", "viscosity"})
      if (x.number_or(name, 0) != 0) x.moves_differently(std::string("the drag of its ") + name + " is not modelled");
    x.only({"flag"}, {"gravity", "density", "viscosity"});
    for (const auto& f : x.children("flag"))
      f.only({}, {"gravity", "passive", "spring", "damper", "frictionloss", "equality", "contact", "constraint"});
  }
  void switch_off(bool equality, bool contact) {
    no_equality_ = equality, no_contact_ = contact;
    if (contact) contact_.reset();
  }
  bool contact_is_off() const { return no_contact_; }
  void section(const xml_item& x, const mjcf_classes& classes) {
    if (x.name() == "contact") {
      for (const auto& c : x.children()) c.name() == "pair" ? note_contact(c) : c.not_read("not read");
    } else if (x.name() == "tendon") {
      for (const auto& c : x.children()) tendon(classes.resolved(c, ""));
    } else if (x.name() == "deformable") {
      for (const auto& c : x.children())
        c.name() == "skin" ? c.not_read("not read") : c.moves_differently("flexible bodies are not modelled");
    } else {
      x.not_read("not read");
    }
  }
  /// Whether a constraint of <equality> is disabled: it is listed.
  bool constraint(const xml_item& x) const {
    if (!no_equality_ && keyword(x, "active", {"true", "false"}) == "true") return false;
    x.not_read("not read: it is disabled");
    return true;
  }
  /// Attributes of meshes that have no part in their shape, and what is no mesh and no model.
  void assets(const xml_item& x, const mjcf_classes& classes) {
    for (const auto& c : x.children()) {
      if (c.name() == "mesh")
        classes.resolved(c, "").only({}, {"name", "class", "file", "scale", "refpos", "refquat", "vertex", "face",
                                          "inertia", "maxhullvert", "builtin", "params"});
      else if (c.name() == "model")
        c.only({}, {"name", "file"});
      else if (c.name() == "hfield" && contacts_are_read_)
        c.only({}, {"name", "file", "nrow", "ncol", "size", "elevation"});
      else if (kinds_of_assets_.insert(c.node().name).second)
        c.not_read("no <" + excerpt(c.name()) + "> is read");
    }
  }
  /// Notes the attributes of sites; those for their appearance are listed once.
  void site(const xml_item& x) {
    x.only({}, {"name", "class", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "fromto", "size", "type",
                "rgba", "material", "group", "user"});
    if (!x.has("name")) return x.not_read("not read, as it has no name");
    for (const auto* look : {"type", "size", "rgba", "material", "group", "user"})
      if (x.has(look) && looks_.insert(look).second && !site_) site_.emplace(x);
  }
  /// Notes an actuator whose law is not modelled.
  void actuator(const xml_item& x) { actuators_[std::string(x.name())].add(x); }
  /// Notes an actuator that exerts a force without a command.
  void servo(const xml_item& x) { servos_[std::string(x.name())].add(x); }
  /// Emits the collected notes.
  void finish() {
    for (const auto& [kind, a] : actuators_)
      a.first->moves_differently("its law is not modelled, as of others of <" + kind + ">: " + a.list());
    for (const auto& [kind, a] : servos_)
      a.first->warn("the chain has its force, and that of any <" + kind + ">, by kte::add_motors alone: " + a.list());
    if (site_) {
      std::string all;
      for (const auto& look : looks_) all += (all.empty() ? "" : ", ") + look;
      site_->not_read("the appearance of sites is not read: " + all);
    }
    if (contact_)
      contact_->moves_differently("contact is not modelled: friction, solref and others of " +
                                  std::to_string(contacts_) + (contacts_ == 1 ? " element" : " elements"));
  }

 private:
  struct group {
    std::optional<xml_item> first;
    std::string names;
    std::size_t count = 0;
    void add(const xml_item& x) {
      if (count++ == 0) first.emplace(x);
      if (count > 3) return;
      const auto name = x.text_or("name", ""), joint = x.text_or("joint", "");
      if (count > 1) names += ", ";
      names += name.empty() && !joint.empty() ? "that of joint '" + excerpt(joint) + "'" : "'" + excerpt(name) + "'";
    }
    std::string list() const { return names + (count > 3 ? " and " + std::to_string(count - 3) + " more" : ""); }
  };
  void note_contact(const xml_item& x) {
    if (no_contact_) return;
    if (!contact_) contact_.emplace(x);
    ++contacts_;
  }
  static bool has_force(const std::vector<double>& coefficients) {
    return std::any_of(coefficients.begin(), coefficients.end(), [](double k) { return k != 0; });
  }
  void tendon(const xml_item& x) {
    std::string forces;
    for (const auto* name : {"stiffness", "damping", "frictionloss", "armature"})
      if (x.has(name) && has_force(x.list(name))) forces += std::string(forces.empty() ? "" : ", ") + name;
    if (x.has("range") && x.text_or("limited", "auto") != "false") forces += forces.empty() ? "range" : ", range";
    if (forces.empty()) return x.not_read("not read");
    x.moves_differently("its " + forces + (forces.find(',') == forces.npos ? " is" : " are") + " not modelled");
  }

  std::map<std::string, group> actuators_, servos_;
  std::set<std::string> kinds_of_assets_, looks_;
  std::optional<xml_item> contact_, site_;
  std::size_t contacts_ = 0;
  bool contacts_are_read_;
  bool no_equality_ = false, no_contact_ = false;
};

}  // namespace kte::detail
