#pragma once

#include <kte/dynamics/runtime.hpp>
#include <kte/elements/registry.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/robots/load_robot.hpp>

#include <set>

#include "evaluate/fixed_bodies.hpp"
#include "evaluate/options.hpp"

namespace evaluate {

/// A robot of a file: a chain, and its coordinates in the order of the table's columns.
struct robot_file {
  kte::kte_map_chain chain;
  std::vector<std::string> coordinates;
};

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
    r.chain = without_fixed_bodies(kte::to_chain(kte::load_model(o.robot)));
    if (o.gravity) r.chain.gravity(*o.gravity);
    for (const auto& e : kte::layout(r.chain)) r.coordinates.push_back(e.name);
    return r;
  }
  const auto wanted = robot_options_of(o);
  const auto robot = kte::load_robot(o.robot, wanted);
  r.chain = without_fixed_bodies(robot.chain);
  std::set<std::string> free;
  for (const auto& e : kte::layout(r.chain)) free.insert(e.name);
  if (o.floating_base) r.coordinates.push_back(wanted.base_coordinate);
  for (const auto& name : robot.joints)  // those that follow others have no columns
    if (free.contains(name)) r.coordinates.push_back(name);
  return r;
}

}  // namespace evaluate
