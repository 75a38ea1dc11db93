#pragma once

#include <kte/robots/detail/sdf_values.hpp>

#include <map>

namespace kte::detail {

/// The scope of names: outside of a nested model, the names of its links, joints and frames begin with the names of the
/// enclosing models, "leg::foot". A merged model has a frame but no scope.
struct sdf_scope {
  std::string prefix, model = "__model__";  ///< "leg::", and the frame of the model

  std::string full(const std::string& name) const {
    constexpr std::string_view own = "::__model__";
    if (name == "__model__") return model;
    return prefix + (name.ends_with(own) ? name.substr(0, name.size() - own.size()) : name);
  }
};

/// The frames of a model in SDF by their full names: links, joints, models and explicit frames, each relative to
/// another. The frame of the outermost model is "__model__".
class sdf_frames {
 public:
  struct frame {
    std::string relative_to;
    robot_pose pose;
    std::string attached_to;  ///< the frame that moves it; empty for a link, its own name for a model without links
    xml_item from;
  };

  std::string canonical;  ///< the frame to which the outermost model is attached

  void add(const std::string& name, const frame& f) {
    const auto [it, fresh] = frames_.try_emplace(name, f);
    if (!fresh) f.from.fail("there is another frame of this name");
  }
  bool has(const std::string& name) const { return frames_.contains(name); }
  /// Sets the pose of a model; the pose may be that of a frame inside of it.
  void place(const std::string& name, const robot_pose& pose) { frames_.find(name)->second.pose = pose; }
  void attach(const std::string& name, const std::string& to) { frames_.find(name)->second.attached_to = to; }
  /// The full name of a name written in a scope.
  std::string find(const xml_item& asks, const sdf_scope& scope, const std::string& name) const {
    auto full = scope.full(name);
    if (name == "world" && !has(full)) full = name;
    if (full != outermost && !has(full)) asks.fail("there is no frame '" + excerpt(name) + "'");
    return full;
  }

  /// The pose of `to` in `from`; a pose written between the two is returned unchanged.
  robot_pose relative(const xml_item& asks, const std::string& from, const std::string& to) const {
    auto up = way(asks, from), down = way(asks, to);
    while (!up.empty() && !down.empty() && up.back() == down.back()) up.pop_back(), down.pop_back();
    return inverse_of(along(up)) * along(down);
  }
  /// The link, or "world", to which a frame is attached.
  std::string link_of(const xml_item& asks, const std::string& name) const {
    std::string at = name == outermost ? canonical : name;
    for (std::size_t steps = 0;; ++steps) {
      const auto it = frames_.find(at);
      if (it == frames_.end() || it->second.attached_to == at)
        asks.fail("the frame '" + excerpt(name) + "' is not attached to a link");
      if (it->second.attached_to.empty()) return at;
      if (steps > frames_.size()) it->second.from.fail("it is attached to itself, directly or through other frames");
      at = it->second.attached_to == outermost ? canonical : it->second.attached_to;
    }
  }

 private:
  static constexpr const char* outermost = "__model__";
  using entry = const std::pair<const std::string, frame>*;

  /// The frames from the named one to the outermost.
  std::vector<entry> way(const xml_item& asks, const std::string& name) const {
    std::vector<entry> all;
    for (std::string at = name; at != outermost;) {
      const auto it = frames_.find(at);
      if (it == frames_.end()) asks.fail("there is no frame '" + excerpt(at) + "'");
      if (all.size() > frames_.size())
        it->second.from.fail("its pose is relative to itself, directly or through other frames");
      all.push_back(&*it), at = it->second.relative_to;
    }
    return all;
  }
  static robot_pose along(const std::vector<entry>& way) {
    robot_pose all;
    for (const auto* e : way) all = is_nothing(all) ? e->second.pose : e->second.pose * all;
    return all;
  }
  std::map<std::string, frame, std::less<>> frames_;
};

}  // namespace kte::detail
