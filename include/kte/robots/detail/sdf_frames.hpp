#pragma once

#include <kte/robots/detail/sdf_values.hpp>

#include <unordered_map>

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

  void add(const std::string& name, frame f) {
    const auto [it, fresh] = numbers_.try_emplace(name, frames_.size());
    if (!fresh) f.from.fail("there is another frame of this name");
    frames_.push_back({std::move(f), &it->first});
  }
  bool has(const std::string& name) const { return numbers_.contains(name); }
  /// Sets the pose of a model; the pose may be that of a frame inside of it.
  void place(const std::string& name, const robot_pose& pose) { named(name).pose = pose, forget(); }
  void attach(const std::string& name, const std::string& to) { named(name).attached_to = to, forget(); }
  /// The full name of a name written in a scope.
  std::string find(const xml_item& asks, const sdf_scope& scope, const std::string& name) const {
    auto full = scope.full(name);
    if (name == "world" && !has(full)) full = name;
    if (full != outermost && !has(full)) asks.fail("there is no frame '" + excerpt(name) + "'");
    return full;
  }

  /// The pose of `to` in `from`; a pose written between the two is returned unchanged.
  robot_pose relative(const xml_item& asks, const std::string& from, const std::string& to) const {
    std::size_t a = number_of(asks, from), b = number_of(asks, to);
    const auto first = in_model(a), second = in_model(b);
    robot_pose up, down;
    std::size_t first_depth = first.depth, second_depth = second.depth;
    for (std::size_t steps = 0; a != b; ++steps) {
      if (steps > long_way) return inverse_of(first.pose) * second.pose;
      const bool of_first = first_depth > second_depth, of_second = second_depth > first_depth;
      if (!of_second) up = along(up, a), a = frames_[a].above, --first_depth;
      if (!of_first) down = along(down, b), b = frames_[b].above, --second_depth;
    }
    return inverse_of(up) * down;
  }
  /// The pose of a frame in one that it is relative to, directly or through others; otherwise that of `relative`.
  robot_pose inside(const xml_item& asks, const std::string& outer, const std::string& name) const {
    const auto end = number_of(asks, outer);
    robot_pose p;
    std::size_t at = number_of(asks, name);
    for (std::size_t steps = 0; at != end; ++steps) {
      if (at == none || steps > frames_.size()) return relative(asks, outer, name);
      p = along(p, at), at = above(at);
    }
    return p;
  }
  /// The link, or "world", to which a frame is attached.
  const std::string& link_of(const xml_item& asks, const std::string& name) const {
    const std::string* at = name == outermost ? &canonical_ : &name;
    std::vector<std::size_t> passed;
    std::size_t found = none;
    while (found == none) {
      const auto it = numbers_.find(*at);
      if (it == numbers_.end() || frames_[it->second].attached_to == *at)
        asks.fail("the frame '" + excerpt(name) + "' is not attached to a link");
      const auto& f = frames_[it->second];
      if (passed.size() > frames_.size()) f.from.fail("it is attached to itself, directly or through other frames");
      if (f.attached_to.empty()) {
        found = it->second;
      } else if (f.link_version == version_) {
        found = f.link;
      } else {
        passed.push_back(it->second);
        at = f.attached_to == outermost ? &canonical_ : &f.attached_to;
      }
    }
    for (const auto p : passed) frames_[p].link = found, frames_[p].link_version = version_;
    return *frames_[found].name;
  }

 private:
  static constexpr const char* outermost = "__model__";
  static constexpr std::size_t none = ~std::size_t{0};  ///< stands for the outermost frame where frames have numbers
  /// Poses over longer ways are those in the model.
  static constexpr std::size_t long_way = 128;
  struct place_in_model {
    std::size_t depth = 0;  ///< frames up to the outermost
    robot_pose pose;
  };
  /// A frame, and what was computed of it; this holds while its version is that of all frames.
  struct entry : frame {
    entry(frame f, const std::string* of) : frame(std::move(f)), name(of) {}
    const std::string* name;
    bool linked = false;  ///< whether `above` is known
    std::size_t above = none, link = none;
    std::size_t place_version = 0, link_version = 0;
    place_in_model place;
  };

  entry& named(const std::string& name) { return frames_[numbers_.find(name)->second]; }
  void forget() { ++version_; }

  std::size_t number_of(const xml_item& asks, const std::string& name) const {
    if (name == outermost) return none;
    const auto it = numbers_.find(name);
    if (it == numbers_.end()) asks.fail("there is no frame '" + excerpt(name) + "'");
    return it->second;
  }
  /// The frame that a frame is relative to.
  std::size_t above(std::size_t i) const {
    auto& f = frames_[i];
    if (!f.linked) f.above = number_of(f.from, f.relative_to), f.linked = true;
    return f.above;
  }
  /// The pose of a frame in the outermost, each computed once.
  place_in_model in_model(std::size_t i) const {
    std::vector<std::size_t> open;
    place_in_model p;
    for (; i != none; i = above(i)) {
      if (frames_[i].place_version == version_) {
        p = frames_[i].place;
        break;
      }
      if (open.size() > frames_.size())
        frames_[i].from.fail("its pose is relative to itself, directly or through other frames");
      open.push_back(i);
    }
    for (; !open.empty(); open.pop_back()) {
      auto& f = frames_[open.back()];
      p = f.place = {p.depth + 1, p.pose * f.pose}, f.place_version = version_;
    }
    return p;
  }
  /// A pose in a frame as one in the frame above.
  robot_pose along(const robot_pose& p, std::size_t i) const {
    return is_nothing(p) ? frames_[i].pose : frames_[i].pose * p;
  }

  std::string canonical_;
  std::unordered_map<std::string, std::size_t> numbers_;
  mutable std::vector<entry> frames_;
  std::size_t version_ = 1;
};

}  // namespace kte::detail
