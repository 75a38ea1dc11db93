#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

namespace kte::test {

/// A temporary file, removed at the end.
struct scratch {
  std::filesystem::path path;

  explicit scratch(const std::string& extension = ".txt", const std::string& content = "")
      : path(std::filesystem::temp_directory_path() / ("kte_" + std::to_string(std::random_device{}()) + extension)) {
    write(content);
  }
  scratch(const scratch&) = delete;
  scratch& operator=(const scratch&) = delete;
  ~scratch() { std::filesystem::remove(path); }

  void write(const std::string& content) const { std::ofstream(path, std::ios::binary) << content; }
  std::string text() const {
    std::ostringstream s;
    s << std::ifstream(path, std::ios::binary).rdbuf();
    return s.str();
  }
};

/// An empty folder, removed at the end.
struct scratch_folder {
  std::filesystem::path path;
  scratch_folder() {
    const scratch file;
    path = file.path.string() + ".folder";
    std::filesystem::create_directory(path);
  }
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;
  ~scratch_folder() { std::filesystem::remove_all(path); }
  auto entries() const {
    return std::distance(std::filesystem::directory_iterator(path), std::filesystem::directory_iterator());
  }
};

/// The extension of every format of tables.
inline const std::string table_extensions[]{".ssv", ".csv", ".tsv", ".npy", ".mcap"};

/// What the error of type Error says that f() throws; empty where it throws none.
template <class Error, class F>
std::string message_of(const F& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}
/// The message after the path of a file, as in "kte: 'PATH', line 3: ...".
template <class Error, class F>
std::string message_about(const scratch& file, const F& f) {
  const std::string what = message_of<Error>(f), path = "kte: '" + file.path.string() + "', ";
  return what.starts_with(path) ? what.substr(path.size()) : what;
}

}  // namespace kte::test
