#include <kte/robots/mjcf_reader.hpp>
#include <kte/robots/sdf_reader.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/robots/urdf_reader.hpp>

#include <cstddef>
#include <cstdint>

/// Whatever stands in a file of a robot, it is a robot or an error of this library. One program for all formats: most
/// of it is what they have in common.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto d = text.find("<mujoco") != text.npos ? kte::from_mjcf(text, "file")
                   : text.find("<sdf") != text.npos  ? kte::from_sdf(text, "file")
                                                     : kte::from_urdf(text, "file");
    (void)kte::to_robot(d);
    if (!d.links.empty())
      (void)kte::to_robot(d, {.root = d.links.back().name, .floating_base = true, .fold_fixed = true});
  } catch (const kte::error&) {
  }
  return 0;
}
