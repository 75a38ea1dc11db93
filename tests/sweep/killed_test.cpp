#include <kte/sweep.hpp>

#include <csignal>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "catch.hpp"
#include "sweep/folder.hpp"

namespace killed_test {

std::size_t shards_in(const std::filesystem::path& parts) {
  std::size_t n = 0;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(parts, none)) n += entry.path().extension() == ".shard";
  return n;
}

TEST_CASE("a sweep that is killed continues where it was, and gives the same bytes") {
  const folder at;
  const auto cases = kte::random_cases(400, 3, {kte::normal("x", 0, 1)});
  const auto sweep_of = [&cases](int microseconds, std::size_t threads) {
    return kte::sweep(cases, {"square"},
                      [microseconds](const auto& c) {
                        ::usleep(static_cast<useconds_t>(microseconds));
                        if (c.index() == 11) throw kte::bad_argument("eleven");
                        return std::array{c["x"] * c["x"]};
                      },
                      {.shard_size = 10, .executor = kte::batch::threads(threads)});
  };
  sweep_of(0, 1).to(at / "whole.npy");

  const auto file = at / "killed.npy";
  for (int kills = 1; kills <= 2; ++kills) {
    const ::pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      sweep_of(2000, 2).to(file);
      ::_exit(0);
    }
    for (int i = 0; i < 1000 && shards_in(at / "killed.npy.parts") < 8U * static_cast<unsigned>(kills); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::kill(child, SIGKILL);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    CHECK_FALSE(std::filesystem::exists(file));
  }
  const auto missing = sweep_of(0, 1).missing(file).size();
  CHECK((missing > 0 && missing <= 40 - 16));
  sweep_of(0, 2).to(file);
  CHECK(bytes_of(file) == bytes_of(at / "whole.npy"));
  CHECK(bytes_of(at / "killed.npy.failures.csv") == bytes_of(at / "whole.npy.failures.csv"));
  CHECK_FALSE(std::filesystem::exists(at / "killed.npy.parts"));
}

}  // namespace killed_test
