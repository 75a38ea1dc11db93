#pragma once

#include <kte/io/recording.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/runtime_chain/layout.hpp>
#include <kte/runtime_chain/static_chain_map.hpp>

#include <boost/hana/for_each.hpp>

namespace kte {

struct robot_shape;

namespace detail {

/// An element of a chain, as data.
struct element_parts {
  std::string type;
  std::span<const port> ports;
  std::vector<std::string> names;
  std::vector<parameter_record> parameters;
  bool rigid = false;       ///< a joint or a link
  bool holds_code = false;  ///< a function of the program, which has no parameters
};
/// A shape of a robot's file.
struct shape_parts {
  const robot_shape* shape;
  std::string_view frame;
  bool collision;
  std::string_view file;  ///< that includes it; empty for the robot's own
};

/// A chain as data, with the additional parts of a robot. The library kte::view, which does not know the types of
/// chains, makes scenes from it.
struct chain_parts {
  vec3<> gravity{};
  std::vector<element_parts> elements;
  std::vector<layout_entry<std::string>> layout;
  named_slots slots;
  bool unrecorded = false;  ///< whether it has parts that no file can hold
  std::string title;
  std::string file;                      ///< of a robot
  std::vector<std::string> search_path;  ///< of its meshes
  std::vector<double> lower, upper;      ///< over v
  std::vector<shape_parts> shapes;
};

template <class Core, class... Keys>
element_parts parts_of(const element<Core, Keys...>& e) {
  element_parts p{std::string(std::string_view(Core::type)),
                  Core::ports,
                  {std::string(Keys::name)...},
                  {},
                  is_transmission<Core>,
                  holds_code<Core>};
  if constexpr (!holds_code<Core>) p.parameters = record_of(e.core, p.names).parameters;
  return p;
}
template <class Gravity, class... E>
chain_parts parts_of(const static_chain<Gravity, E...>& c) {
  chain_parts p;
  p.gravity = as<double>(c.gravity());
  boost::hana::for_each(c.elements(), [&p](const auto& e) { p.elements.push_back(parts_of(e)); });
  for (const auto& e : layout(c)) p.layout.push_back({std::string(e.name), e.what, e.q, e.nq, e.v, e.nv});
  p.slots = slots_of(c);
  return p;
}
inline chain_parts parts_of(const runtime_chain& c) {
  chain_parts p;
  const topology& t = c.wiring();
  p.gravity = c.gravity();
  for (const auto& e : t.elements) {
    auto& x =
        p.elements.emplace_back(element_parts{std::string(e.type), e.ports, {}, {}, e.rigid, e.element->holds_code()});
    for (std::size_t i = 0; i < e.ports.size(); ++i)
      x.names.push_back(t.names[static_cast<std::size_t>(e.ports[i].what)][static_cast<std::size_t>(e.index[i])]);
    if (!x.holds_code) x.parameters = e.element->record().parameters;
  }
  p.layout = layout(c), p.slots = slots_of(t), p.unrecorded = c.unrecorded() != nullptr;
  return p;
}

/// A type with a chain and shapes: a `robot`. A template, so that drawing chains does not include robots.
template <class T>
concept robot_like = requires(const T& r) {
  r.chain.wiring();
  r.shapes;
  r.limits.lower;
};
template <robot_like Robot>
chain_parts parts_of(const Robot& r) {
  auto p = parts_of(r.chain);
  p.title = r.name, p.file = r.file, p.search_path = r.search_path;
  p.lower = r.limits.lower, p.upper = r.limits.upper;
  for (const auto& s : r.shapes) p.shapes.push_back({&s, s.frame, s.collision, s.file});
  return p;
}

/// The parts of a manipulator, with its limits.
template <class T>
chain_parts parts_with_limits(const T& c) {
  auto p = parts_of(c);
  if constexpr (requires { c.limits().lower; }) {
    const auto& l = c.limits();
    p.lower.assign(l.lower.begin(), l.lower.end()), p.upper.assign(l.upper.begin(), l.upper.end());
  }
  return p;
}

template <class T>
const T& chain_in(const T& c) {
  return c;
}
template <robot_like Robot>
const auto& chain_in(const Robot& r) {
  return r.chain;
}

}  // namespace detail

/// Types that can be drawn: a static chain, a runtime chain, a robot.
template <class T>
concept drawable = requires(const T& c) {
  detail::parts_of(c);
};

}  // namespace kte
