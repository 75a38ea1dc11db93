#include <kte/io/replace_file.hpp>

#if __has_include(<sys/resource.h>)
#  include <csignal>
#  include <sys/resource.h>
#endif

#include "catch.hpp"
#include "scratch.hpp"

namespace file_test {

namespace fs = std::filesystem;
using kte::detail::replace_file;
using kte::test::scratch_folder;

std::string message(const fs::path& path) {
  return kte::test::message_of<kte::bad_file>([&] { replace_file(path, "new"); });
}
std::string text_of(const fs::path& path) { return kte::detail::read_file(path); }

TEST_CASE("a file is replaced as a whole, and keeps its permissions") {
  const scratch_folder folder;
  const auto path = folder.path / "model.json";
  replace_file(path, "old");
  for (const auto kept : {0600, 0664, 0444, 0755}) {
    fs::permissions(path, static_cast<fs::perms>(kept));
    replace_file(path, "new");
    CHECK(text_of(path) == "new");
    CHECK(fs::status(path).permissions() == static_cast<fs::perms>(kept));
  }
  CHECK(folder.entries() == 1);
}

TEST_CASE("links stay links") {
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

  auto last = link;
  for (int i = 0; i < 20; ++i) {
    const auto next = folder.path / std::to_string(i);
    fs::create_symlink(last, next);
    last = next;
  }
  replace_file(last, "far");
  CHECK(text_of(target) == "far");
  CHECK(fs::is_symlink(last));

  const auto loop = folder.path / "loop.json";
  fs::create_symlink("loop.json", loop);
  CHECK(message(loop) == "kte: cannot write '" + loop.string() + "': Too many levels of symbolic links");
}

TEST_CASE("after a failure nothing is left behind") {
  const scratch_folder folder;
  const auto path = folder.path / "model.json";
  fs::create_directory(path);
  CHECK(message(path) == "kte: cannot write '" + path.string() + "': Is a directory");
  CHECK(message(path / "none" / "x.json").ends_with("': No such file or directory"));
  CHECK(folder.entries() == 1);
  fs::remove(path);
  if (fs::exists("/dev/full")) {  // targets that are not files are written directly, not replaced
    fs::create_symlink("/dev/full", path);
    CHECK(message(path) == "kte: cannot write '" + path.string() + "': No space left on device");
    CHECK((fs::is_symlink(path) && fs::is_character_file("/dev/full")));
    CHECK(folder.entries() == 1);
  }
}

#if __has_include(<sys/resource.h>)
TEST_CASE("a full disk is said by name, and nothing has changed") {
  const scratch_folder folder;
  const auto path = folder.path / "model.json";
  replace_file(path, "old");
  rlimit usual{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &usual) == 0);
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{1000, usual.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &little) == 0);
  const auto of = [&path](std::size_t size, bool sync) {
    return kte::test::message_of<kte::bad_file>([&] { replace_file(path, std::string(size, 'x'), {.sync = sync}); });
  };
  const std::string messages[]{of(1001, false), of(100000, false), of(100000, true)}, fits = of(1000, true);
  ::setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, before);
  for (const auto& m : messages) CHECK(m == "kte: cannot write '" + path.string() + "': File too large");
  CHECK(fits.empty());
  CHECK(text_of(path) == std::string(1000, 'x'));
  CHECK(folder.entries() == 1);
}
#endif

TEST_CASE("what is written beside a file is new, and for its owner alone where the file may be") {
  const scratch_folder folder;
  const auto path = folder.path / "model.json", victim = folder.path / "victim";
  std::ofstream(victim) << "precious";
  fs::create_symlink("victim", path.string() + ".part");
  replace_file(path, "new");
  replace_file(path, "newer", {.sync = true});
  CHECK(text_of(victim) == "precious");
  CHECK(folder.entries() == 3);
  CHECK(fs::status(path).permissions() == fs::status(victim).permissions());  // by umask

  using kte::detail::create_file;
  for (const auto& taken : {victim, fs::path(path.string() + ".part"), folder.path}) {
    CHECK_FALSE(create_file(taken, false));
    CHECK(errno == EEXIST);
  }
  CHECK(text_of(victim) == "precious");
  CHECK(create_file(folder.path / "mine", true));
  CHECK(fs::status(folder.path / "mine").permissions() == (fs::perms::owner_read | fs::perms::owner_write));

  const kte::detail::part_file one(path, true), other(path, true);
  CHECK(one.path() != other.path());
  CHECK(one.path().parent_path() == folder.path);
  const fs::path longest = folder.path / std::string(255, 'x');
  replace_file(longest, "of the longest name");
  CHECK(text_of(longest) == "of the longest name");
}

TEST_CASE("of a file with more bytes than are allowed there are more than these, else all") {
  const scratch_folder folder;
  const auto path = folder.path / "model.json";
  for (const std::size_t size : {1, 1 << 14, (1 << 14) + 1, 3 << 14}) {  // it is read in parts of 2^14 bytes
    replace_file(path, std::string(size, 'x'));
    CHECK(kte::detail::read_file(path, size).size() == size);
    CHECK(kte::detail::read_file(path, size - 1).size() >= size);
    if (size > 1 << 14) CHECK(kte::detail::read_file(path, 1 << 14).size() > 1 << 14);
  }
}

}  // namespace file_test
