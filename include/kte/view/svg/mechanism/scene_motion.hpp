#pragma once

#include <kte/contract/nearest_name.hpp>
#include <kte/math/quaternion.hpp>
#include <kte/view/svg/scene_parts.hpp>

namespace kte::detail::svg {

/// The pose of a frame in the world.
struct placed_frame {
  vec3<> position{};
  unit_quaternion<> rotation{};
  vec3<> operator()(const vec3<>& inside) const { return position + rotation * inside; }
};
inline placed_frame placed(const scene::pose& p) { return {{p[0], p[1], p[2]}, normalized(p[3], p[4], p[5], p[6])}; }
inline placed_frame operator*(const placed_frame& a, const placed_frame& b) {
  return {a(b.position), a.rotation * b.rotation};
}

/// The poses of all frames of a scene at any time of a recording.
class scene_motion {
 public:
  /// Throws `bad_argument` for a recording that does not exist or does not fit the frames.
  scene_motion(const scene& s, std::size_t recording) : scene_(s) {
    if (recording >= s.recordings.size())
      raise<bad_argument>("kte: a picture of recording " + std::to_string(recording) + " of a scene that has " +
                          std::to_string(s.recordings.size()));
    recording_ = &s.recordings[recording];
    const std::size_t n = recording_->t.size(), tracks = static_cast<std::size_t>(s.tracks);
    if (n == 0 || recording_->positions.size() != n * tracks * 3 || recording_->rotations.size() != n * tracks * 4)
      raise<bad_argument>("kte: a recording of a scene needs a pose of each track at each time");
    check_parts(s);
  }

  const scene& of() const { return scene_; }
  const std::vector<double>& times() const { return recording_->t; }
  /// Whether a frame rests in the world: rigid in it, or a base that does not move in the recording.
  bool rests(int frame) const {
    while (frame >= 0 && scene_.frames[at(frame)].track < 0) frame = scene_.frames[at(frame)].parent;
    return frame < 0 || (is_base(frame) && stays(scene_.frames[at(frame)].track));
  }
  /// All frames at a time. Between recorded times positions are interpolated linearly, and rotations at constant rate.
  std::vector<placed_frame> frames(double t) const {
    const auto& all = times();
    const auto next = std::upper_bound(all.begin(), all.end(), t);
    const std::size_t b = (std::min)(static_cast<std::size_t>(next - all.begin()), all.size() - 1),
                      a = b == 0 ? 0 : b - 1;
    const double length = all[b] - all[a], u = length > 0 ? std::clamp((t - all[a]) / length, 0.0, 1.0) : 0;
    std::vector<placed_frame> placed_frames;
    placed_frames.reserve(scene_.frames.size());
    for (const auto& f : scene_.frames) {
      if (f.track >= 0)
        placed_frames.push_back(between(track(a, f.track), track(b, f.track), u));
      else
        placed_frames.push_back((f.parent < 0 ? placed_frame{} : placed_frames[at(f.parent)]) * placed(f.place));
    }
    return placed_frames;
  }
  /// The frame with this name. Throws `unknown_name`.
  int frame(const std::string& name) const {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < scene_.frames.size(); ++i) {
      if (scene_.frames[i].name == name) return static_cast<int>(i);
      known.push_back(scene_.frames[i].name);
    }
    const std::string meant = did_you_mean(name, known);
    raise<unknown_name>("kte: the picture has no frame '" + name + "'" +
                        (meant.empty() ? ": " + list_of_names(known) : meant));
  }

 private:
  /// Whether no part of the mechanism moves a frame.
  bool is_base(int frame) const {
    for (const auto& j : scene_.joints)
      if (j.after == frame) return false;
    for (const auto& l : scene_.links)
      if (l.to == frame) return false;
    for (const auto& f : scene_.forces)
      if (f.kind == "loop" && f.frames.size() >= 2 && f.frames.back() == frame) return false;
    return true;
  }
  bool stays(int track) const {
    const auto same = [&](const auto& numbers, std::size_t size) {
      const std::size_t row = size * at(scene_.tracks), first = size * at(track);
      for (std::size_t i = first; i < numbers.size(); i += row)
        if (!std::equal(&numbers[i], &numbers[i] + size, &numbers[first])) return false;
      return true;
    };
    return same(recording_->positions, 3) && same(recording_->rotations, 4);
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  placed_frame track(std::size_t row, int track) const {
    const std::size_t i = row * at(scene_.tracks) + at(track);
    const float* p = &recording_->positions[3 * i];
    const std::int16_t* r = &recording_->rotations[4 * i];
    return {{p[0], p[1], p[2]}, normalized<double>(r[0], r[1], r[2], r[3])};
  }
  static placed_frame between(const placed_frame& a, const placed_frame& b, double u) {
    const auto &x = a.rotation, &y = b.rotation;
    const double w = dot(x, y) < 0 ? -u : u;
    return {a.position + u * (b.position - a.position), normalized((1 - u) * x.w + w * y.w, (1 - u) * x.x + w * y.x,
                                                                   (1 - u) * x.y + w * y.y, (1 - u) * x.z + w * y.z)};
  }

  const scene& scene_;
  const scene::recording* recording_ = nullptr;
};

}  // namespace kte::detail::svg
