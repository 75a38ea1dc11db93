#pragma once

#include <kte/robots/detail/contact_leftovers.hpp>
#include <kte/robots/detail/mjcf_tree.hpp>

#include <cmath>
#include <cstdint>

/// Reads contacts of MJCF.
namespace kte::detail {

/// Reads how a geom touches others.
inline robot_touch read_mjcf_touch(const xml_item& x, contact_leftovers& left) {
  robot_touch t;
  const auto bits = [&x](const char* name) {
    const double n = x.number_or(name, 1);
    if (!(n >= -2147483648.0 && n <= 4294967295.0) || n != std::floor(n))
      x.fail(std::string(name) + " must be an integer of 32 bits, got " + number(n));
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(n));
  };
  t.type = bits("contype"), t.affinity = bits("conaffinity");
  t.friction = x.has("friction") ? x.completed_list("friction")[0] : 1;
  if (!(*t.friction >= 0)) x.fail("friction must not be negative, got " + number(*t.friction));
  t.priority = static_cast<int>(x.number_or("priority", 0)), t.dimensions = static_cast<int>(x.number_or("condim", 3));
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
  if (x.has("friction")) p.friction = x.list("friction")[0];
  if (x.has("condim") && x.number("condim") < 3) p.friction = 0;
  for (const char* const name : {"solref", "solreffriction", "solimp", "margin", "gap"})
    if (x.has(name)) left.add(x, name);
  x.only({}, {"name", "class", "geom1", "geom2", "friction", "condim", "solref", "solreffriction", "solimp", "margin",
              "gap"});
  return p;
}

}  // namespace kte::detail
