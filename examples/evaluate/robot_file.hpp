#pragma once

#include <kte/dynamics/runtime.hpp>
#include <kte/elements/registry.hpp>
#include <kte/io/model_content.hpp>
#include <kte/robots/load_robot.hpp>

#include <algorithm>
#include <set>

#include "evaluate/fixed_bodies.hpp"
#include "evaluate/options.hpp"

namespace evaluate {

/// A robot of a file: a chain, and its coordinates in the order of the table's columns.
struct robot_file {
  kte::kte_map_chain chain;
  std::vector<std::string> coordinates;
  std::vector<std::string> warnings;  ///< with file and line, each once
};

/// "arm.urdf:37: what is odd", of each note once.
inline std::vector<std::string> texts_of(const std::vector<kte::robot_note>& notes, const std::string& source) {
  std::vector<std::string> all;
  for (const auto& note : notes) {
    const auto text = kte::detail::place_text(source, note.line) + note.text;
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
  }
  return all;
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
  const auto bytes = kte::detail::text_of_file(o.robot);
  if (const auto model = kte::detail::model_in(bytes, o.robot)) {
    if (o.floating_base || o.joint_dynamics)
      throw kte::bad_argument("kte: a model file is taken as it is, without --floating-base and --joint-dynamics");
    r.chain = without_fixed_bodies(kte::to_chain(*model));
    if (o.gravity) r.chain.gravity(*o.gravity);
    for (const auto& e : kte::layout(r.chain)) r.coordinates.push_back(e.name);
    return r;
  }
  const auto wanted = robot_options_of(o);
  const auto robot = kte::to_robot(kte::describe_robot(bytes, o.robot.string(), wanted), wanted);
  r.warnings = texts_of(robot.warnings, o.robot.string());
  r.chain = without_fixed_bodies(robot.chain);
  std::set<std::string> free;
  for (const auto& e : kte::layout(r.chain)) free.insert(e.name);
  if (o.floating_base) r.coordinates.push_back(wanted.base_coordinate);
  for (const auto& name : robot.joints)  // those that follow others have no columns
    if (free.contains(name)) r.coordinates.push_back(name);
  return r;
}

}  // namespace evaluate
