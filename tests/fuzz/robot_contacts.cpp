#include <kte/robots/mjcf_reader.hpp>
#include <kte/robots/sdf_reader.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/robots/urdf_reader.hpp>

#include <cstddef>
#include <cstdint>

/// Whatever stands in a file of a robot, its contacts with the ground, with height fields and the shapes of feet, are
/// made or refused by an error of this library.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const kte::robot_options options{.floating_base = true, .contacts = {.ground = "world", .rim_points = 3}};
  try {
    const auto d = text.find("<mujoco") != text.npos ? kte::from_mjcf(text, "file", options)
                   : text.find("<sdf") != text.npos  ? kte::from_sdf(text, "file", options)
                                                     : kte::from_urdf(text, "file", options);
    (void)kte::to_robot(d, options);
  } catch (const kte::error&) {
  }
  return 0;
}
