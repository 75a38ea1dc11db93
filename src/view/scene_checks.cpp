#include "scene_checks.hpp"

#include <kte/errors.hpp>

#include <algorithm>

namespace kte {

std::vector<std::string> not_drawn(const scene& s) {
  std::vector<std::string> all;
  for (const auto& note : s.notes)
    if (note.find(" is not drawn: ") != note.npos) all.push_back(note);
  return all;
}

}  // namespace kte

namespace kte::view {

namespace {
[[noreturn]] void fail(const std::string& why) { detail::raise<bad_argument>("kte: a scene: " + why); }

void check_index(int i, std::size_t count, const std::string& of) {
  if (i < 0 || static_cast<std::size_t>(i) >= count)
    fail(of + " is " + std::to_string(i) + ", and there are " + std::to_string(count));
}
void check_indices(const std::vector<int>& all, std::size_t count, const std::string& of) {
  for (const int i : all) check_index(i, count, of);
}
void check(const scene::recording& r, std::size_t tracks, std::size_t nq, std::size_t nv) {
  const std::size_t rows = r.t.size();
  const std::string of = "recording '" + r.name + "'";
  if (rows == 0) fail(of + " has no rows");
  if (r.positions.size() != 3 * rows * tracks || r.rotations.size() != 4 * rows * tracks)
    fail(of + " has not a pose for each row and track");
  if (!r.q.empty() && r.q.size() != rows * nq) fail(of + " has not all coordinates for each row");
  if (!r.v.empty() && r.v.size() != rows * nv) fail(of + " has not all velocities for each row");
  if (r.signals.size() % rows != 0) fail(of + " has not all signals for each row");
  if (!std::is_sorted(r.t.begin(), r.t.end())) fail(of + ": its times decrease");
  for (const auto& c : r.columns)
    if (c.data.size() != rows) fail(of + ": column '" + c.name + "' has not a number for each row");
}
}  // namespace

void check(const scene& s) {
  const std::size_t frames = s.frames.size(), coordinates = s.coordinates.size();
  if (s.dimension != 2 && s.dimension != 3) fail("its dimension is " + std::to_string(s.dimension));
  if (s.tracks < 0) fail("its number of tracks is negative");
  for (std::size_t i = 0; i < frames; ++i) {
    const auto& f = s.frames[i];
    const auto of = "frame '" + f.name + "': its ";
    if (f.track >= 0)
      check_index(f.track, static_cast<std::size_t>(s.tracks), of + "track");
    else if (f.parent != -1)
      check_index(f.parent, i, of + "parent");
  }
  for (const auto& j : s.joints) {
    const auto of = "joint '" + j.name + "': its ";
    check_index(j.before, frames, of + "frame"), check_index(j.after, frames, of + "frame");
    check_indices(j.coordinates, coordinates, of + "coordinate");
  }
  for (const auto& l : s.links)
    check_index(l.from, frames, "a " + l.type + ": its frame"),
        check_index(l.to, frames, "a " + l.type + ": its frame");
  for (const auto& b : s.bodies) check_index(b.frame, frames, "body '" + b.name + "': its frame");
  for (const auto& f : s.forces) {
    check_indices(f.frames, frames, f.type + " '" + f.name + "': its frame");
    check_indices(f.coordinates, coordinates, f.type + " '" + f.name + "': its coordinate");
  }
  check_indices(s.pulls, frames, "what is pulled");
  for (const auto& x : s.shapes) {
    check_index(x.frame, frames, "a shape: its frame");
    if (x.mesh >= 0) check_index(x.mesh, s.meshes.size(), "a shape: its mesh");
  }
  for (const auto& m : s.meshes) {
    if (m.positions.size() % 3 != 0 || m.indices.size() % 3 != 0)
      fail("mesh '" + m.name + "' has a part of a triangle");
    for (const auto i : m.indices)
      if (i >= m.positions.size() / 3) fail("mesh '" + m.name + "' has no vertex " + std::to_string(i));
  }
  if (s.recordings.empty()) fail("it has no recording, and so no pose");
  for (const auto& r : s.recordings) check(r, static_cast<std::size_t>(s.tracks), s.q.size(), s.v.size());
}

}  // namespace kte::view
