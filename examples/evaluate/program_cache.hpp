#pragma once

#include <kte/contract/key.hpp>
#include <kte/io/file.hpp>

#include <cstdlib>
#include <functional>
#include <sys/stat.h>
#include <unistd.h>

/// Programs that are kept, where nobody else can put one.
namespace evaluate {

/// The folder for them: in $XDG_CACHE_HOME if that is an absolute path, as the XDG Base Directory Specification wants
/// it, or else in ~/.cache. Throws `kte::bad_argument` where there is neither.
inline std::filesystem::path cache_folder() {
  for (const auto& [variable, below] : {std::pair("XDG_CACHE_HOME", ""), std::pair("HOME", ".cache")}) {
    const char* const value = std::getenv(variable);
    if (value && std::filesystem::path(value).is_absolute())
      return std::filesystem::path(value) / below / "kte-evaluate";
  }
  throw kte::bad_argument(
      "kte: --static keeps programs below $XDG_CACHE_HOME or $HOME, and neither is an absolute path");
}

/// Makes a folder that only its user can read and write. Throws `kte::bad_file` if it is there and may be another's.
inline void make_private_folder(const std::filesystem::path& folder) {
  std::error_code error;
  const auto parent = folder.parent_path();
  if (std::filesystem::create_directories(parent, error))  // as that specification wants it
    std::filesystem::permissions(parent, std::filesystem::perms::owner_all, error);
  if (error) kte::detail::raise_file("make", parent, error.value());
  if (mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) kte::detail::raise_file("make", folder, errno);
  struct stat found {};
  if (lstat(folder.c_str(), &found) != 0) kte::detail::raise_file("use", folder, errno);
  const char* const why = S_ISLNK(found.st_mode)                       ? "is a link"
                          : !S_ISDIR(found.st_mode)                    ? "is not a folder"
                          : found.st_uid != geteuid()                  ? "belongs to another user"
                          : (found.st_mode & (S_IWGRP | S_IWOTH)) != 0 ? "may be written by others"
                                                                       : nullptr;
  if (why) throw kte::bad_file("kte: no program is run from '" + folder.string() + "', as it " + why);
  if (chmod(folder.c_str(), S_IRWXU) != 0) kte::detail::raise_file("make private", folder, errno);
}

/// 64 bits in 16 digits.
inline std::string hash_text(std::string_view bytes) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(kte::detail::hash(bytes)));
  return text;
}

/// Files of a private folder that end in the hash of what is before it: programs do not mind what comes behind them.
class program_cache {
 public:
  explicit program_cache(std::filesystem::path folder) : folder_(std::move(folder)) { make_private_folder(folder_); }

  std::filesystem::path program(const std::string& name) const { return folder_ / name; }
  /// Whether a program is there and none of its bytes has changed.
  bool has(const std::string& name) const {
    std::error_code none;
    if (!std::filesystem::exists(program(name), none)) return false;
    const auto bytes = kte::detail::read_file(program(name));
    const auto size = bytes.size() - std::min(bytes.size(), hash_length);
    return std::string_view(bytes).substr(size) == hash_text(std::string_view(bytes).substr(0, size));
  }
  /// make(folder) makes the file `program` in a folder of its own, which is removed in the end; the program gets its
  /// name when it is complete.
  void add(const std::string& name, const std::function<void(const std::filesystem::path&)>& make) const {
    std::string pattern = (folder_ / (name + ".XXXXXX")).string();
    if (!mkdtemp(pattern.data())) kte::detail::raise_file("make", pattern, errno);
    const removed_folder aside{pattern};
    make(aside.path);
    const auto made = aside.path / "program";
    const auto hash = hash_text(kte::detail::read_file(made));
    const auto f = kte::detail::open_file(made, "ab");
    if (std::fwrite(hash.data(), 1, hash.size(), f.get()) != hash.size() || std::fflush(f.get()) != 0)
      kte::detail::raise_file("write", made, errno);
    std::error_code error;
    std::filesystem::rename(made, program(name), error);
    if (error) kte::detail::raise_file("make", program(name), error.value());
  }

 private:
  static constexpr std::size_t hash_length = 16;
  struct removed_folder {
    std::filesystem::path path;
    ~removed_folder() {
      std::error_code none;
      std::filesystem::remove_all(path, none);
    }
  };
  std::filesystem::path folder_;
};

}  // namespace evaluate
