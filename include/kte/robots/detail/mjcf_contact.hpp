#pragma once

#include <kte/robots/detail/contact_leftovers.hpp>
#include <kte/robots/detail/mjcf_geom.hpp>

/// Reads contacts of MJCF.
namespace kte::detail {

/// condim: 1 without friction, 3 with friction, 4 and 6 also against turning and rolling.
inline int contact_dimensions(const xml_item& x) {
  const int n = x.whole_or("condim", 3, 1, 6);
  if (n == 2 || n == 5) x.fail("condim must be 1, 3, 4 or 6, got " + std::to_string(n));
  return n;
}

/// The first number of its friction.
inline double sliding_friction(const xml_item& x) {
  const auto all = x.list("friction");
  if (all.empty()) x.fail("its friction has no number");
  if (!(all[0] >= 0)) x.fail("friction must not be negative, got " + number(all[0]));
  return all[0];
}

/// Reads how a geom touches others.
inline robot_touch read_mjcf_touch(const xml_item& x, contact_leftovers& left) {
  robot_touch t;
  t.type = contact_bits(x, "contype"), t.affinity = contact_bits(x, "conaffinity");
  t.friction = x.has("friction") ? sliding_friction(x) : 1;
  t.priority = x.whole_or("priority", 0), t.dimensions = contact_dimensions(x);
  for (const char* const name : {"solref", "solimp", "solmix"})
    if (x.has(name)) left.add(x, name);
  for (const char* const name : {"margin", "gap"})
    if (x.number_or(name, 0) != 0) left.add(x, name);
  if (t.dimensions > 3) left.add(x, "condim above 3");
  return t;
}

/// Reads a <pair> or an <exclude>.
inline robot_contact_pair read_mjcf_pair(const xml_item& x, const mjcf_scope& in, contact_leftovers& left) {
  const bool excluded = x.name() == "exclude";
  robot_contact_pair p;
  p.excluded = excluded, p.line = x.line(), p.file = x.file();
  p.name1 = in.named(x.text(excluded ? "body1" : "geom1")), p.name2 = in.named(x.text(excluded ? "body2" : "geom2"));
  for (auto* name : {&p.name1, &p.name2})
    if (excluded && *name == in.named("world")) *name = "world";
  if (excluded) return x.only({}, {"name", "class", "body1", "body2"}), p;
  if (x.has("friction")) p.friction = sliding_friction(x);
  if (contact_dimensions(x) < 3) p.friction = 0;
  for (const char* const name : {"solref", "solreffriction", "solimp", "margin", "gap"})
    if (x.has(name)) left.add(x, name);
  x.only({}, {"name", "class", "geom1", "geom2", "friction", "condim", "solref", "solreffriction", "solimp", "margin",
              "gap"});
  return p;
}

}  // namespace kte::detail
