#include <kte/io/model_writer.hpp>

#include <random>

#include "catch.hpp"
#include "scratch.hpp"

#if __has_include(<sys/wait.h>)
#  include <array>
#  include <csignal>
#  include <ctime>
#  include <sys/wait.h>
#  include <unistd.h>

namespace model_crash_test {

/// Two models of different lengths.
std::array<kte::model_record, 2> two_models() {
  std::array<kte::model_record, 2> models;
  for (int i = 0; i < 2; ++i)
    for (int n = 0; n < 300 + 100 * i; ++n)
      models[static_cast<std::size_t>(i)].elements.push_back(
          {"inertia_gen", 1, {{"coordinate", "q"}}, {{"mass", {n + 0.5 * i}}}});
  return models;
}

TEST_CASE("whenever a program is killed that saves a model, there is the old file or the new one", "[long]") {
  const auto models = two_models();
  std::mt19937 engine(1);
  for (const char* extension : {".json", ".xml", ".kte"}) {
    const kte::test::scratch_folder folder;
    const auto file = folder.path / (std::string("model") + extension);
    const auto format = kte::detail::model_format_of(file);
    kte::detail::save_record(file, format, models[0]);
    int saved = 0;
    for (int kills = 0; kills < 40 || (saved == 0 && kills < 400); ++kills) {  // more on a busy machine, and later
      const auto child = ::fork();
      REQUIRE(child >= 0);
      if (child == 0)
        for (std::size_t i = 1;; i = 1 - i) kte::detail::save_record(file, format, models[i]);
      const std::timespec moment{0, static_cast<long>(engine() % 20000000) * (1 + kills / 40)};
      ::nanosleep(&moment, nullptr);
      REQUIRE(::kill(child, SIGKILL) == 0);
      int status = 0;
      REQUIRE(::waitpid(child, &status, 0) == child);
      REQUIRE((WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
      const auto found = kte::load_model(file);
      REQUIRE((found == models[0] || found == models[1]));
      saved += found == models[1];
    }
    CHECK(saved > 0);
    const auto left = folder.entries();
    kte::detail::save_record(file, format, models[0]);  // what killed programs left behind is in nobody's way
    CHECK(kte::load_model(file) == models[0]);
    CHECK(folder.entries() == left);
  }
}

TEST_CASE("whatever saves a model at the same time, the file is whole", "[long]") {
  const auto models = two_models();
  for (const char* extension : {".json", ".kte"}) {
    const kte::test::scratch_folder folder;
    const auto file = folder.path / (std::string("model") + extension);
    const auto format = kte::detail::model_format_of(file);
    kte::detail::save_record(file, format, models[0]);
    constexpr int writers = 4;
    for (int w = 0; w < writers; ++w) {
      const auto child = ::fork();
      REQUIRE(child >= 0);
      if (child != 0) continue;
      int code = 0;
      try {
        for (std::size_t i = 0; i < 60; ++i) kte::detail::save_record(file, format, models[i % 2]);
      } catch (...) {
        code = 1;
      }
      ::_exit(code);
    }
    for (int ended = 0; ended < writers;) {
      const auto found = kte::load_model(file);
      REQUIRE((found == models[0] || found == models[1]));
      int status = 0;
      if (::waitpid(-1, &status, WNOHANG) == 0) continue;
      ++ended;
      CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
    }
    CHECK(folder.entries() == 1);
  }
}

}  // namespace model_crash_test
#endif
