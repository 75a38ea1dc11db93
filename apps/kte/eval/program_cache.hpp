#pragma once

#include <kte/contract/key.hpp>

#include <cstdlib>
#include <functional>

#include "eval/private_file.hpp"

/// Programs that are kept, where nobody else can put one.
namespace evaluate {

/// The folder for them: in $XDG_CACHE_HOME if that is an absolute path, as the XDG Base Directory Specification wants
/// it, or else in ~/.cache. Throws `kte::bad_argument` where there is neither.
inline std::filesystem::path cache_folder() {
  for (const auto& [variable, below] : {std::pair("XDG_CACHE_HOME", ""), std::pair("HOME", ".cache")}) {
    const char* const value = std::getenv(variable);
    if (value && std::filesystem::path(value).is_absolute()) return std::filesystem::path(value) / below / "kte";
  }
  throw kte::bad_argument(
      "kte: --static keeps programs below $XDG_CACHE_HOME or $HOME: set one of them to an absolute path");
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

  std::filesystem::path path_of(const std::string& name) const { return folder_ / name; }
  /// Opens a program if it exists and no byte has changed. The descriptor ensures that the checked file is run. None if
  /// it is not there, or damaged. Throws `bad_file` if it is a link, or may be another's.
  descriptor find(const std::string& name) const {
    auto file = open_private(path_of(name));
    if (file.get() < 0) return file;
    const auto bytes = read_all(file, path_of(name));
    const auto size = bytes.size() - std::min(bytes.size(), hash_length);
    const bool whole = std::string_view(bytes).substr(size) == hash_text(std::string_view(bytes).substr(0, size));
    return whole ? std::move(file) : descriptor();
  }
  /// make(folder) makes the file `program` in its own folder (mode 0700), which is removed in the end; the program gets
  /// its name when it is complete.
  void add(const std::string& name, const std::function<void(const std::filesystem::path&)>& make) const {
    std::string pattern = (folder_ / (name + ".XXXXXX")).string();
    if (!mkdtemp(pattern.data())) kte::detail::raise_file("make", pattern, errno);
    const removed_folder aside{pattern};
    make(aside.path);
    const auto made = aside.path / "program";
    const auto hash = hash_text(kte::detail::read_file(made));
    {
      const auto f = kte::detail::open_file(made, "ab");
      if (std::fwrite(hash.data(), 1, hash.size(), f.get()) != hash.size() || std::fflush(f.get()) != 0)
        kte::detail::raise_file("write", made, errno);
    }
    if (chmod(made.c_str(), S_IRWXU) != 0) kte::detail::raise_file("make private", made, errno);
    std::error_code error;
    std::filesystem::rename(made, path_of(name), error);
    if (error) kte::detail::raise_file("make", path_of(name), error.value());
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
