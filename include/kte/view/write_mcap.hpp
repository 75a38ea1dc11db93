#pragma once

#include <kte/view/recorded_scene.hpp>

#include <filesystem>

namespace kte {

/// Writes the recording of a scene as MCAP, which Foxglove shows: topics
///   /kte        t, the coordinates and the columns, a table that `read_table` reads
///   /tf         foxglove.FrameTransforms of the frames that move, /tf_static of those that are rigid in others
///   /scene      foxglove.SceneUpdate of bodies and shapes, once; /scene/lines of links and forces
/// The parent frame is `origin`. The file is replaced after all is written. Throws `bad_argument` for a scene of
/// several recordings, for times below 0, and for names of coordinates and columns that no table has, `bad_file` where
/// it cannot be written.
void write_mcap(const std::filesystem::path& path, const scene& s);
inline void write_mcap(const std::filesystem::path& path, const recorded_scene& r) { write_mcap(path, r.contents()); }

}  // namespace kte
