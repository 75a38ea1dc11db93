#pragma once

#include <kte/errors.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

/// Files of the C library, whose errors have a reason.
namespace kte::detail {

[[noreturn]] inline void raise_file(const char* action, const std::filesystem::path& path, int code) {
  raise<bad_file>(std::string("kte: cannot ") + action + " '" + path.string() + "': " + std::strerror(code));
}

struct close_file {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using file_handle = std::unique_ptr<std::FILE, close_file>;

inline file_handle open_file(const std::filesystem::path& path, const char* mode) {
  file_handle f(std::fopen(path.string().c_str(), mode));
  if (!f) raise_file("open", path, errno);
  return f;
}

/// All bytes of a file, or the first bytes beyond `largest`. Memory is proportional to the actual size, whatever
/// headers claim.
inline std::string read_file(const std::filesystem::path& path, std::size_t largest = ~std::size_t{0}) {
  std::string bytes;
  const auto f = open_file(path, "rb");
  char part[1 << 14];
  while (const auto n = std::fread(part, 1, sizeof part, f.get())) {
    bytes.append(part, n);
    if (bytes.size() > largest) return bytes;
  }
  if (std::ferror(f.get())) raise_file("read", path, errno);
  return bytes;
}

/// The extension of a file name in lower case.
inline std::string lower_extension(const std::filesystem::path& path) {
  std::string text = path.extension().string();
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

}  // namespace kte::detail
