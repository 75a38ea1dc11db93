#include <kte/robots/to_robot.hpp>
#include <kte/robots/urdf_reader.hpp>

#include <cstddef>
#include <cstdint>

/// Whatever stands in a file in URDF, it is a robot or an error of this library.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto d = kte::from_urdf({reinterpret_cast<const char*>(data), size}, "file");
    kte::to_robot(d);
    kte::to_robot(d, {.root = d.links.back().name, .floating_base = true, .fold_fixed = true});
  } catch (const kte::error&) {
  }
  return 0;
}
