#pragma once

#include "eval/fixed_bodies.hpp"
#include "mechanism.hpp"

namespace evaluate {

/// A chain without bodies that stand still, and its coordinates in the order of the table's columns.
struct evaluated_robot {
  kte::runtime_chain chain;
  std::vector<std::string> coordinates;

  explicit evaluated_robot(const kte_tool::mechanism& m)
      : chain(without_fixed_bodies(m.chain())), coordinates(kte_tool::coordinates_of(m, chain)) {}
};

}  // namespace evaluate
