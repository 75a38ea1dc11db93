#pragma once

#include <kte/io/file.hpp>
#include <kte/io/save_options.hpp>

#include <random>

#if __has_include(<unistd.h>)
#  include <fcntl.h>
#  include <unistd.h>
#endif

/// Files that are replaced as a whole. On POSIX systems other users cannot open a file that is being written; other
/// systems use the standard library only.
namespace kte::detail {

/// The target of symbolic links, even if it does not exist yet.
inline std::filesystem::path link_target(std::filesystem::path path) {
  std::error_code none;
  for (int links = 0; std::filesystem::is_symlink(path, none); ++links) {
    if (links == 40) raise_file("write", path, ELOOP);
    path = path.parent_path() / std::filesystem::read_symlink(path, none);
  }
  return path;
}

/// Creates a file, private to its owner or with default permissions. Returns nullptr and sets errno; EEXIST if the name
/// is in use, even by a link.
inline file_handle create_file(const std::filesystem::path& path, [[maybe_unused]] bool private_to_owner) {
#if __has_include(<unistd.h>)
  const int usual = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  const int descriptor = ::open(path.c_str(), usual, private_to_owner ? 0600 : 0666);
  if (descriptor < 0) return nullptr;
  file_handle f(::fdopen(descriptor, "wb"));
  if (!f) {
    const int code = errno;
    ::close(descriptor), ::unlink(path.c_str());
    errno = code;
  }
  return f;
#else
  return file_handle(std::fopen(path.string().c_str(), "wbx"));
#endif
}

/// Flushes the written data to the disk. Returns the error number, or 0.
inline int sync_file(std::FILE* f) {
#if __has_include(<unistd.h>)
  return std::fflush(f) == 0 && ::fsync(::fileno(f)) == 0 ? 0 : errno;
#else
  return f == nullptr ? 0 : ENOSYS;
#endif
}
inline int sync_folder([[maybe_unused]] const std::filesystem::path& path) {
#if __has_include(<unistd.h>)
  const int descriptor = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int code = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return code;
#else
  return ENOSYS;
#endif
}

/// Writes all bytes and closes the file.
inline int write_all(file_handle f, std::string_view bytes, bool sync) {
  errno = 0;
  int code = std::fwrite(bytes.data(), 1, bytes.size(), f.get()) == bytes.size() ? 0 : errno != 0 ? errno : EIO;
  if (code == 0 && sync) code = sync_file(f.get());
  if (std::fclose(f.release()) != 0 && code == 0) code = errno;
  return code;
}

/// A file `target.NUMBER.part` with an unused name. It is removed, unless it replaces the target.
class part_file {
 public:
  /// Throws `bad_file` if no file can be created.
  part_file(const std::filesystem::path& target, bool private_to_owner) {
    const auto stem = target.parent_path() / target.filename().string().substr(0, 200);  // names have at most 255 bytes
    std::random_device random;
    for (int tries = 0; !file_; ++tries) {
      char ending[24];
      std::snprintf(ending, sizeof ending, ".%08x.part", random());
      auto path = stem;
      path += ending;
      file_ = create_file(path, private_to_owner);
      if (file_)
        path_ = std::move(path);
      else if (errno != EEXIST || tries == 100)
        raise_file("write", target, errno);
    }
  }
  part_file(const part_file&) = delete;
  part_file& operator=(const part_file&) = delete;
  ~part_file() {
    std::error_code none;
    if (!path_.empty()) std::filesystem::remove(path_, none);
  }

  const std::filesystem::path& path() const { return path_; }
  /// The handle; call it once.
  file_handle file() { return std::move(file_); }
  /// Returns the error number, or 0.
  int rename_to(const std::filesystem::path& target) {
    std::error_code error;
    std::filesystem::rename(path_, target, error);
    if (!error) path_.clear();
    return error.value();
  }

 private:
  file_handle file_;
  std::filesystem::path path_;
};

/// Replaces a file after everything is written: writes to a part file in the same folder, which does not remain while
/// the program runs. Several programs may replace a file at the same time; it is then complete and written by one of
/// them. The file keeps its permissions; a new file has default permissions. Symbolic links remain; their target is
/// replaced. Targets that are not regular files, such as pipes, are written directly. Throws `bad_file` with the path
/// and the reason. The file is then unchanged, unless it has been replaced and only its folder cannot be synced.
inline void replace_file(const std::filesystem::path& path, std::string_view bytes, const save_options& options = {}) {
  std::error_code error;
  const auto target = link_target(path), folder = target.parent_path();  // nothing is allocated after the replacement
  const auto old = std::filesystem::status(target, error);
  const bool exists = std::filesystem::exists(old);
  int code = 0;
  if (exists && !std::filesystem::is_regular_file(old)) {
    file_handle f(std::fopen(target.string().c_str(), "wb"));
    code = f ? write_all(std::move(f), bytes, false) : errno;
  } else {
    part_file part(target, exists);
    if (exists) std::filesystem::permissions(part.path(), old.permissions(), error), code = error.value();
    if (code == 0) code = write_all(part.file(), bytes, options.sync);
    if (code == 0) code = part.rename_to(target);
    if (code == 0 && options.sync) code = sync_folder(folder);
  }
  if (code != 0) raise_file("write", path, code);
}

}  // namespace kte::detail
