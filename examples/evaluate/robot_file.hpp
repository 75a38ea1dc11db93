#pragma once

#include <kte/elements/registry.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/robots/load_robot.hpp>

#include <set>

#include "evaluate/options.hpp"

namespace evaluate {

/// A robot of a file: a chain, and its coordinates in the order of the table's columns.
struct robot_file {
  kte::kte_map_chain chain;
  std::vector<std::string> coordinates;
};

/// The model without bodies that do not move: those on bases, and on what is rigidly linked to them.
inline kte::model_record without_fixed_bodies(const kte::model_record& m) {
  std::set<std::string> fixed, written;
  kte::model_record out{m.gravity, {}};
  for (const auto& e : m.elements) {
    const auto& to = e.connections;
    if (e.type.starts_with("rigid_link_") && !e.type.ends_with("_gen")) {
      if (written.insert(to[0].name).second || fixed.contains(to[0].name)) fixed.insert({to[0].name, to[1].name});
      written.insert(to[1].name);
    } else if (e.type == "base_2D" || e.type == "base_3D") {
      fixed.insert(to[0].name), written.insert(to[0].name);
    } else if (e.type == "inertia_2D" || e.type == "inertia_3D") {
      if (fixed.contains(to[0].name)) continue;
    } else {
      for (const auto& c : to) written.insert(c.name);
    }
    out.elements.push_back(e);
  }
  return out;
}

/// The library's own files are .json, or XML that says <cereal>; all else describes robots.
inline bool is_model(const std::filesystem::path& path) {
  if (path.extension() == ".json") return true;
  return path.extension() == ".xml" && kte::detail::read_file(path).find("<cereal>") != std::string::npos;
}

inline kte::robot_options robot_options_of(const options& o) {
  kte::robot_options r;
  r.gravity = o.gravity;
  r.floating_base = o.floating_base;
  r.joint_dynamics = o.joint_dynamics;
  return r;
}

inline robot_file read_robot(const options& o) {
  robot_file r;
  if (is_model(o.robot)) {
    if (o.floating_base || o.joint_dynamics)
      throw kte::bad_argument("kte: a model file is taken as it is, without --floating-base and --joint-dynamics");
    r.chain = kte::to_chain(without_fixed_bodies(kte::load_model(o.robot)));
    if (o.gravity) r.chain.gravity(*o.gravity);
    for (const auto& e : layout(r.chain)) r.coordinates.push_back(e.name);
    return r;
  }
  const auto wanted = robot_options_of(o);
  const auto robot = kte::load_robot(o.robot, wanted);
  r.chain = kte::to_chain(without_fixed_bodies(record_of(robot.chain)));
  std::set<std::string> free;
  for (const auto& e : layout(r.chain)) free.insert(e.name);
  if (o.floating_base) r.coordinates.push_back(wanted.base_coordinate);
  for (const auto& name : robot.joints)  // those that follow others have no columns
    if (free.contains(name)) r.coordinates.push_back(name);
  return r;
}

}  // namespace evaluate
