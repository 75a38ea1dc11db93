#pragma once

#include <kte/io/file.hpp>

#include <cstdlib>

namespace kte_tool {

/// A folder for temporary files that only its user can read (mkdtemp: mode 0700), removed at the end with what is in
/// it. Throws `kte::bad_file` where none can be made.
class private_folder {
 public:
  /// In the folder of the system for temporary files; its name begins with this.
  explicit private_folder(const std::string& name) {
    auto pattern = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
    if (mkdtemp(pattern.data()) == nullptr) kte::detail::raise_file("make", pattern, errno);
    path_ = pattern;
  }
  private_folder(const private_folder&) = delete;
  private_folder& operator=(const private_folder&) = delete;
  ~private_folder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace kte_tool
