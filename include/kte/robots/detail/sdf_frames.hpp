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

  /// The frame to which the outermost model is attached.
  const std::string& canonical() const { return canonical_; }
  void set_canonical(const std::string& to) { canonical_ = to, forget(); }

  void add(const std::string& name, const frame& f) {
    const auto [it, fresh] = frames_.try_emplace(name, f);
    if (!fresh) f.from.fail("there is another frame of this name");
    forget();
  }
  bool has(const std::string& name) const { return frames_.contains(name); }
  /// Sets the pose of a model; the pose may be that of a frame inside of it.
  void place(const std::string& name, const robot_pose& pose) { frames_.find(name)->second.pose = pose, forget(); }
  void attach(const std::string& name, const std::string& to) { frames_.find(name)->second.attached_to = to, forget(); }
  /// The full name of a name written in a scope.
  std::string find(const xml_item& asks, const sdf_scope& scope, const std::string& name) const {
    auto full = scope.full(name);
    if (name == "world" && !has(full)) full = name;
    if (full != outermost && !has(full)) asks.fail("there is no frame '" + excerpt(name) + "'");
    return full;
  }

  /// The pose of `to` in `from`; a pose written between the two is returned unchanged.
  robot_pose relative(const xml_item& asks, const std::string& from, const std::string& to) const {
    const auto a = in_model(asks, from), b = in_model(asks, to);
    if (a.depth + b.depth > long_way) return inverse_of(a.pose) * b.pose;
    auto up = way(from), down = way(to);
    while (!up.empty() && !down.empty() && up.back() == down.back()) up.pop_back(), down.pop_back();
    return inverse_of(along(up)) * along(down);
  }
  /// The link, or "world", to which a frame is attached.
  std::string link_of(const xml_item& asks, const std::string& name) const {
    std::string at = name == outermost ? canonical_ : name;
    std::vector<std::string> passed;
    for (;;) {
      const auto it = frames_.find(at);
      if (it == frames_.end() || it->second.attached_to == at)
        asks.fail("the frame '" + excerpt(name) + "' is not attached to a link");
      if (it->second.attached_to.empty()) break;
      if (passed.size() > frames_.size())
        it->second.from.fail("it is attached to itself, directly or through other frames");
      if (const auto known = links_.find(at); known != links_.end()) {
        at = known->second;
        break;
      }
      passed.push_back(at);
      at = it->second.attached_to == outermost ? canonical_ : it->second.attached_to;
    }
    for (const auto& p : passed) links_.emplace(p, at);
    return at;
  }

 private:
  static constexpr const char* outermost = "__model__";
  using entry = const std::pair<const std::string, frame>*;
  /// Poses over longer ways are those in the model.
  static constexpr std::size_t long_way = 128;
  struct place_in_model {
    std::size_t depth = 0;  ///< frames up to the outermost
    robot_pose pose;
  };

  void forget() { places_.clear(), links_.clear(); }
  /// The pose of a frame in the outermost, each computed once.
  place_in_model in_model(const xml_item& asks, const std::string& name) const {
    std::vector<entry> open;
    place_in_model p;
    for (std::string at = name; at != outermost;) {
      if (const auto known = places_.find(at); known != places_.end()) {
        p = known->second;
        break;
      }
      const auto it = frames_.find(at);
      if (it == frames_.end()) asks.fail("there is no frame '" + excerpt(at) + "'");
      if (open.size() > frames_.size())
        it->second.from.fail("its pose is relative to itself, directly or through other frames");
      open.push_back(&*it), at = it->second.relative_to;
    }
    for (; !open.empty(); open.pop_back())
      p = places_.emplace(open.back()->first, place_in_model{p.depth + 1, p.pose * open.back()->second.pose})
              .first->second;
    return p;
  }

  /// The frames from the named one, which `in_model` knows, to the outermost.
  std::vector<entry> way(const std::string& name) const {
    std::vector<entry> all;
    for (std::string at = name; at != outermost;) {
      const auto it = frames_.find(at);
      all.push_back(&*it), at = it->second.relative_to;
    }
    return all;
  }
  static robot_pose along(const std::vector<entry>& way) {
    robot_pose all;
    for (const auto* e : way) all = is_nothing(all) ? e->second.pose : e->second.pose * all;
    return all;
  }
  std::string canonical_;
  std::map<std::string, frame, std::less<>> frames_;
  mutable std::map<std::string, place_in_model, std::less<>> places_;
  mutable std::map<std::string, std::string, std::less<>> links_;
};

}  // namespace kte::detail
