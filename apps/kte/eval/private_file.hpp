#pragma once

#include <kte/io/file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

/// Folders and files that nobody but their user can have put there.
namespace evaluate {

/// An open file or folder.
class descriptor {
 public:
  explicit descriptor(int fd = -1) : fd_(fd) {}
  descriptor(descriptor&& o) noexcept : fd_(std::exchange(o.fd_, -1)) {}
  descriptor& operator=(descriptor&& o) noexcept {
    std::swap(fd_, o.fd_);
    return *this;
  }
  ~descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] inline void refuse_to_run(const std::filesystem::path& path, const char* why) {
  throw kte::bad_file("kte: no program is run from '" + path.string() + "', as it " + why);
}

/// Throws `bad_file` unless it belongs to this user, and no other may write to it.
inline void check_private(const struct stat& found, const std::filesystem::path& path) {
  if (found.st_uid != geteuid()) refuse_to_run(path, "belongs to another user");
  if ((found.st_mode & (S_IWGRP | S_IWOTH)) != 0) refuse_to_run(path, "may be written by others");
}

/// The folders above belong to this user or to root, and what others may write to is sticky, as /tmp is: else they
/// could put another folder in its place.
inline void check_way_to(const std::filesystem::path& folder) {
  for (auto above = folder.parent_path(); !above.empty(); above = above.parent_path()) {
    struct stat found {};
    if (stat(above.c_str(), &found) != 0) kte::detail::raise_file("use", above, errno);
    if (found.st_uid != geteuid() && found.st_uid != 0) refuse_to_run(above, "belongs to another user");
    if ((found.st_mode & S_IWOTH) != 0 && (found.st_mode & S_ISVTX) == 0)
      refuse_to_run(above, "may be written by others");
    if (above == above.parent_path()) break;
  }
}

/// A folder that only its user can read and write, made if it is not there. Throws `bad_file` if it may be another's.
inline void make_private_folder(const std::filesystem::path& folder) {
  std::error_code error;
  const auto parent = folder.parent_path();
  if (std::filesystem::create_directories(parent, error))  // as the XDG Base Directory Specification wants it
    std::filesystem::permissions(parent, std::filesystem::perms::owner_all, error);
  if (error) kte::detail::raise_file("make", parent, error.value());
  if (mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST) kte::detail::raise_file("make", folder, errno);
  struct stat found {};
  if (lstat(folder.c_str(), &found) != 0) kte::detail::raise_file("use", folder, errno);
  if (S_ISLNK(found.st_mode)) refuse_to_run(folder, "is a link");
  if (!S_ISDIR(found.st_mode)) refuse_to_run(folder, "is not a folder");
  check_private(found, folder);
  check_way_to(folder);
  const descriptor open_folder(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (open_folder.get() < 0 || fchmod(open_folder.get(), S_IRWXU) != 0)
    kte::detail::raise_file("make private", folder, errno);
}

/// A file that is there, open; without it none. Throws `bad_file` if it is a link, no file, or may be another's.
inline descriptor open_private(const std::filesystem::path& path) {
  descriptor file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.get() < 0) {
    if (errno == ENOENT) return file;
    if (errno == ELOOP) refuse_to_run(path, "is a link");
    kte::detail::raise_file("open", path, errno);
  }
  struct stat found {};
  if (fstat(file.get(), &found) != 0) kte::detail::raise_file("use", path, errno);
  if (!S_ISREG(found.st_mode)) refuse_to_run(path, "is not a file");
  check_private(found, path);
  return file;
}

/// All bytes of an open file.
inline std::string read_all(const descriptor& file, const std::filesystem::path& path) {
  std::string bytes;
  char part[1 << 14];
  for (;;) {
    const auto n = read(file.get(), part, sizeof part);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) kte::detail::raise_file("read", path, errno);
    if (n == 0) return bytes;
    bytes.append(part, static_cast<std::size_t>(n));
  }
}

}  // namespace evaluate
