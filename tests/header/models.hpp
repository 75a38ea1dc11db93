#pragma once

#include <kte/contract/port.hpp>
#include <kte/elements/registry.hpp>

#include "chain/elements_page.hpp"

/// Models for headers: one for each type of element that files know, named like it, and some whose names and numbers
/// are awkward.
namespace header_models {

/// What the element reads is declared before it.
inline kte::model_record with_bases(const kte::element_record& e, const kte::kte_element& made) {
  kte::model_record m{{0, 0, -9.81}, {}};
  if (made.ports().back().what == kte::kind::contact) {  // of a body that moves
    const std::string suffix = made.ports()[0].what == kte::kind::frame_2D ? "_2D" : "_3D";
    const auto &ground = made.names()[0], &body = made.names()[1];
    m.elements.push_back({"base" + suffix, 1, {{"base", ground}}, {}});
    m.elements.push_back({"free_joint" + suffix, 1, {{"coordinate", "pose"}, {"base", ground}, {"end", body}}, {}});
    m.elements.push_back(e);
    return m;
  }
  for (std::size_t p = 0; p < made.ports().size(); ++p) {
    const auto& port = made.ports()[p];
    if (kte::is_signal(port.what) || port.writes() || (port.how != kte::access::on && !kte::is_frame(port.what)))
      continue;
    const char* type = port.what == kte::kind::gen        ? "base_gen"
                       : port.what == kte::kind::frame_2D ? "base_2D"
                                                          : "base_3D";
    m.elements.push_back({type, 1, {{"base", made.names()[p]}}, {}});
  }
  m.elements.push_back(e);
  return m;
}

/// Numbers are all different, so that none can stand for another, where the element allows that.
inline std::unique_ptr<kte::kte_map> made_of_different_numbers(const kte::element_registry& registry,
                                                               const kte::element_record& record) {
  auto different = record;
  double next = 1;
  for (auto& p : different.parameters)
    if (p.values.size() == 1 && p.name != "side" && p.name != "as_published") p.values[0] = next += 1.0 / 64;
  try {
    return registry.make(different);
  } catch (const kte::bad_parameter&) {
    return registry.make(record);
  }
}

inline std::map<std::string, kte::model_record> all() {
  std::map<std::string, kte::model_record> models;
  const auto registry = kte::element_registry::standard();
  const auto records = elements_page::records();
  if (records.empty()) throw std::runtime_error("docs/elements.md is not found, or has no elements");
  for (auto [type, record] : records) {
    for (auto& p : record.parameters)  // no turn is left out by typed constants
      if (p.name == "rest_rotation") p.values = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    const auto made = made_of_different_numbers(registry, record);
    const auto& e = dynamic_cast<const kte::kte_element&>(*made);
    if (e.ports().back().what == kte::kind::loop) continue;  // headers hold no closures
    models["of_" + type] = with_bases(e.record(), e);        // with all of its parameters
  }
  const auto link = [](const char* from, const char* to, std::vector<double> position, std::vector<double> rotation) {
    return kte::element_record{"rigid_link_3D",
                               1,
                               {{"base", from}, {"end", to}},
                               {{"position", std::move(position)}, {"rotation", std::move(rotation)}}};
  };
  models["awkward"] = {
      {0.1, 0, -9.81},
      {link("class", "a b", {0, 0, -0.5}, {0, 0, 1, 1, 0, 0, 0, 1, 0}),
       link("a b", "a_b", {1e-300, 0.1, 1}, {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1}),
       link("a_b", "\xc3\xa9\"\\\n", {0, 1, 0}, {-1, 0, 0, 0, 1, 0, 0, 0, -1}),
       link("\xc3\xa9\"\\\n", "7", {0, 0, 0}, {0, -1, 0, 1, 0, 0, 0, 0, 1}),
       link("7", "chain", {0, 2, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}),
       link("chain", "awkward", {0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}),
       {"revolute_joint_3D",
        1,
        {{"coordinate", "awkward"}, {"base", "awkward"}, {"end", "__x__"}},
        {{"axis", {0, -1, 0}}, {"position", {0, 0, 0.25}}, {"rotation", {1, 0, 0, 0, 0, -1, 0, 1, 0}}}},
       {"inertia_3D",
        1,
        {{"frame", "__x__"}},
        {{"mass", {2.5}}, {"com", {0, 0, 0.1}}, {"inertia", {0.1, 0, 0.01, 0.2, 0, 0.25}}}}}};
  // Names that are macros (some are in read.cpp), of this library, of std and of the language; of frames and of robots.
  auto& macros = models["macros"];
  macros.gravity = {0, 0, -9.81};
  std::string from = "world";
  for (const char* to : {"M_PI",   "NULL",   "EOF",       "EXIT_SUCCESS", "INFINITY", "NAN",          "errno", "stdin",
                         "assert", "isnan",  "linux",     "unix",         "major",    "minor",        "small", "near",
                         "far",    "IN",     "interface", "ERROR",        "axis",     "inertia_3D",   "std",   "kte",
                         "class",  "macros", "assembled", "robots",       "zero",     "frame_3D_key", "a",     "a_2",
                         "a ",     "a_",     "none",      "x - y"}) {
    macros.elements.push_back(link(from.c_str(), to, {0, 0, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}));
    from = to;
  }
  for (const char* name : {"chain", "axis", "inertia_3D", "std", "kte", "robots", "class", "linux", "M_PI", "zero"})
    models[name] = {{0, 0, -9.81}, {link(name, "end", {0, 0, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1})}};
  return models;
}

}  // namespace header_models
