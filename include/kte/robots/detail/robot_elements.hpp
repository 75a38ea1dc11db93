#pragma once

#include <kte/elements/compiled_elements.hpp>
#include <kte/robots/description.hpp>
#include <kte/runtime_chain.hpp>

#include <string>
#include <unordered_set>

namespace kte::detail {

/// The elements of the chain of a robot, and the names taken in it.
class robot_elements {
 public:
  explicit robot_elements(const robot_description& d) {
    for (const auto& l : d.links) taken_.insert(l.name);
    for (const auto& j : d.joints) taken_.insert(j.name);
    for (const auto& x : d.frames) taken_.insert(x.name);
  }

  runtime_chain& chain() { return chain_; }
  template <class E>
  [[gnu::cold, gnu::noinline]] void append(const E& e) {
    chain_ << e;
  }
  void append_link(const std::string& from, const std::string& to, const robot_pose& place) {
    append(rigid_link_3D(from, to, place.position, place.rotation));
  }

  bool has(const std::string& name) const { return taken_.contains(name); }
  /// An unused name for an intermediate frame.
  std::string fresh(std::string name) {
    while (!taken_.insert(name).second) name += '\'';
    return name;
  }

 private:
  runtime_chain chain_;
  std::unordered_set<std::string> taken_;
};

}  // namespace kte::detail
