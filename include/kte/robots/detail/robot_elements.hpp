#pragma once

#include <kte/elements/compiled_elements.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/detail/free_names.hpp>
#include <kte/runtime_chain.hpp>

#include <string>

namespace kte::detail {

/// The elements of the chain of a robot, and the names taken in it.
class robot_elements {
 public:
  explicit robot_elements(const robot_description& d) {
    names_.reserve(d.links.size() + d.joints.size() + d.frames.size());
    for (const auto& l : d.links) names_.take(l.name);
    for (const auto& j : d.joints) names_.take(j.name);
    for (const auto& x : d.frames) names_.take(x.name);
  }

  runtime_chain& chain() { return chain_; }
  template <class E>
  [[gnu::cold, gnu::noinline]] void append(const E& e) {
    chain_ << e;
  }
  void append_link(const std::string& from, const std::string& to, const robot_pose& place) {
    append(rigid_link_3D(from, to, place.position, place.rotation));
  }

  bool has(const std::string& name) const { return names_.has(name); }
  /// An unused name for an intermediate frame.
  std::string fresh(const std::string& name) { return names_.fresh(name); }

 private:
  runtime_chain chain_;
  free_names names_;
};

}  // namespace kte::detail
