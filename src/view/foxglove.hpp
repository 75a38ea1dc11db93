#pragma once

#include "frame_places.hpp"
#include "json_text.hpp"

/// Messages of Foxglove's schemas, in JSON.
namespace kte::view {

extern const std::string_view frame_transforms_schema, scene_update_schema;

class foxglove_messages {
 public:
  explicit foxglove_messages(const scene& s);

  /// The frames that move by tracks, or those that are rigid in others.
  std::string transforms(std::size_t row, bool moving) const;
  /// Bodies and shapes, in their frames.
  std::string solids() const;
  /// Lines between frames of links and forces, in the world.
  std::string lines(std::size_t row) const;

 private:
  void stamp(json_text& out, std::string_view key, std::size_t row) const;
  void entity(json_text& out, std::string_view id, std::string_view frame, std::size_t row) const;

  const scene& s_;
  const scene::recording& r_;
  std::string origin_ = "origin";
};

}  // namespace kte::view
