#pragma once

#include <kte/runtime_chain.hpp>

#include <set>

namespace evaluate {

/// The chain without bodies that do not move: those on frames that no element moves, and on what is rigidly linked to
/// these. They have no part in any motion, and would add a constant to energies and shift the centre of mass.
inline kte::runtime_chain without_fixed_bodies(const kte::runtime_chain& chain) {
  std::set<std::string, std::less<>> moved;
  const auto is_link = [](const kte::kte_element& e) {
    return e.type() == "rigid_link_3D" || e.type() == "rigid_link_2D";
  };
  chain.for_each_element([&](const kte::kte_element& e) {
    const auto& end = e.ports().back();
    const bool writes_frame = end.how == kte::access::out && kte::is_frame(end.what);
    if (writes_frame && (!is_link(e) || moved.contains(e.names().front()))) moved.insert(e.names().back());
  });
  kte::runtime_chain out;
  chain.for_each_element([&](const kte::kte_element& e) {
    const bool body = e.type() == "inertia_3D" || e.type() == "inertia_2D";
    if (!body || moved.contains(e.names().front())) out.append(e.clone());
  });
  return std::move(out.gravity(chain.gravity()));
}

}  // namespace evaluate
