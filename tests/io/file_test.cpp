#include <kte/io/file.hpp>

#include "catch.hpp"
#include "scratch.hpp"

namespace fs = std::filesystem;
using kte::detail::replace_file;
using kte::test::scratch;

namespace {

std::string message(const fs::path& path) {
  return kte::test::message_of<kte::bad_file>([&] { replace_file(path, "new"); });
}
/// An empty folder, removed at the end.
struct scratch_folder {
  fs::path path;
  scratch_folder() {
    const scratch file;
    path = file.path.string() + ".folder";
    fs::create_directory(path);
  }
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;
  ~scratch_folder() { fs::remove_all(path); }
  auto entries() const { return std::distance(fs::directory_iterator(path), fs::directory_iterator()); }
};
std::string text_of(const fs::path& path) { return kte::detail::read_file(path); }

}  // namespace

TEST_CASE("A file is replaced as a whole, and keeps its permissions") {
  const scratch_folder folder;
  const auto path = folder.path / "model.json";
  replace_file(path, "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  replace_file(path, "new");
  CHECK(text_of(path) == "new");
  CHECK(fs::status(path).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(folder.entries() == 1);
}

TEST_CASE("Links stay links") {
  const scratch_folder folder;
  const auto link = folder.path / "link.json", second = folder.path / "second.json",
             target = folder.path / "target.json";
  fs::create_symlink("target.json", link);
  fs::create_symlink(link, second);
  replace_file(second, "through nothing");
  CHECK(text_of(target) == "through nothing");
  replace_file(link, "new");
  CHECK(text_of(target) == "new");
  CHECK((fs::is_symlink(link) && fs::is_symlink(second) && !fs::is_symlink(target)));
  CHECK(folder.entries() == 3);

  const auto loop = folder.path / "loop.json";
  fs::create_symlink("loop.json", loop);
  CHECK(message(loop) == "kte: cannot write '" + loop.string() + "': Too many levels of symbolic links");
}

TEST_CASE("After a failure nothing is left behind") {
  const scratch_folder folder;
  const auto path = folder.path / "model.json";
  fs::create_directory(path);
  CHECK(message(path) == "kte: cannot write '" + path.string() + "': Is a directory");
  CHECK(message(path / "none" / "x.json").ends_with("': No such file or directory"));
  CHECK(folder.entries() == 1);
  fs::remove(path);
  if (fs::exists("/dev/full")) {  // what is no file is written directly, not replaced
    fs::create_symlink("/dev/full", path);
    CHECK(message(path) == "kte: cannot write '" + path.string() + "': No space left on device");
    CHECK((fs::is_symlink(path) && fs::is_character_file("/dev/full")));
    CHECK(folder.entries() == 1);
  }
}
