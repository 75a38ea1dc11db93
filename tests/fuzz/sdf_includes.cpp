#include <kte/robots/load_robot.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <unistd.h>

namespace {

/// A folder of this process.
const std::filesystem::path& folder() {
  static const auto path = std::filesystem::temp_directory_path() / ("kte_fuzz_" + std::to_string(::getpid()));
  static const bool made = std::filesystem::create_directories(path);
  (void)made;
  return path;
}
void write(const char* name, std::string_view text) { std::ofstream(folder() / name, std::ios::binary) << text; }

}  // namespace

/// Whatever stands in three files in SDF that include each other, which a line "====" separates in the input, they are
/// a robot or an error of this library.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const char* const name : {"robot.sdf", "a.sdf", "b.sdf"}) {
    const auto end = std::min(text.find("\n====\n"), text.size());
    write(name, text.substr(0, end));
    text.remove_prefix(std::min(end + 6, text.size()));
  }
  try {
    (void)kte::load_robot(folder() / "robot.sdf");
  } catch (const kte::error&) {
  }
  return 0;
}
