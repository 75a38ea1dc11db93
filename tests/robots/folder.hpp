#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace kte::test {

/// A temporary folder for files that name each other, removed at the end.
struct folder {
  std::filesystem::path path;

  folder() : path(std::filesystem::temp_directory_path() / ("kte_" + std::to_string(std::random_device{}()))) {
    std::filesystem::create_directories(path);
  }
  folder(const folder&) = delete;
  folder& operator=(const folder&) = delete;
  ~folder() { std::filesystem::remove_all(path); }

  /// Writes a file, whose name may begin with folders; gives its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << content;
    return path / name;
  }
};

}  // namespace kte::test
