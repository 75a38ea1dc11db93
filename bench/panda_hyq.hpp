#pragma once

#include "robots/hyq.hpp"
#include "robots/panda.hpp"

/// Robots with general inertias, which have references for inverse and forward dynamics and M only. Apart from
/// models.hpp, because their chains take their time to compile.
namespace bench {

/// An arm with a hand of two fingers.
struct panda {
  static constexpr auto name = "panda";
  static constexpr auto& chain = robots::panda;
  static constexpr auto& tool = robots::panda_names::hand;
};
/// A robot that floats.
struct hyq {
  static constexpr auto name = "hyq";
  static constexpr auto& chain = robots::hyq;
  static constexpr auto& tool = robots::hyq_names::body;
};

}  // namespace bench
