#include <kte/io/model_writer.hpp>

#include <random>

#include "catch.hpp"
#include "scratch.hpp"

#if __has_include(<sys/wait.h>)
#  include <csignal>
#  include <ctime>
#  include <sys/wait.h>
#  include <unistd.h>

TEST_CASE("whenever a program is killed that saves a model, there is the old file or the new one", "[long]") {
  kte::model_record models[2];
  for (int i = 0; i < 2; ++i)
    for (int n = 0; n < 300 + 100 * i; ++n)
      models[i].elements.push_back({"inertia_gen", 1, {{"coordinate", "q"}}, {{"mass", {n + 0.5 * i}}}});
  std::mt19937 engine(1);
  for (const char* extension : {".json", ".kte"}) {
    const kte::test::scratch file(extension);
    const auto format = kte::detail::model_format_of(file.path);
    kte::detail::save_record(file.path, format, models[0]);
    int saved[2]{};
    for (int kills = 0; kills < 60; ++kills) {
      const auto child = ::fork();
      REQUIRE(child >= 0);
      if (child == 0)
        for (int i = 1;; i = 1 - i) kte::detail::save_record(file.path, format, models[i]);
      const std::timespec moment{0, static_cast<long>(engine() % 30000000)};
      ::nanosleep(&moment, nullptr);
      REQUIRE(::kill(child, SIGKILL) == 0);
      int status = 0;
      REQUIRE(::waitpid(child, &status, 0) == child);
      REQUIRE((WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
      const auto found = kte::load_model(file.path);
      REQUIRE((found == models[0] || found == models[1]));
      ++saved[found == models[1]];
    }
    CHECK(saved[1] > 0);
    kte::detail::save_record(file.path, format, models[0]);  // what a killed program left behind is in nobody's way
    CHECK(kte::load_model(file.path) == models[0]);
    CHECK_FALSE(std::filesystem::exists(file.path.string() + ".part"));
  }
}
#endif
