#include "option_names.hpp"

#include <string>

#include "catch.hpp"

namespace option_names_test {

using kte_tool::with_option_names;

TEST_CASE("messages of the library name options of the program") {
  CHECK(with_option_names("choose one by robot_options::model, of 'a'") == "choose one by --model, of 'a'");
  CHECK(with_option_names("choose one, as by robot_options::model = \"a\"") == "choose one, as by --model \"a\"");
  CHECK(with_option_names("nor in those of robot_options::search_path") == "nor in those of --search");
  CHECK(with_option_names("a larger robot_options::quarter_turn_tolerance makes it exact") ==
        "a larger --quarter-turns makes it exact");
  CHECK(with_option_names("(robot_writing::lossy: it is left out)") == "(--lossy: it is left out)");
  CHECK(with_option_names("the file has more than 10 bytes (read_options::max_bytes)") ==
        "the file has more than 10 bytes");
  CHECK(with_option_names("'robot_options::model' robot_options::model") == "'--model' --model");
  CHECK(with_option_names("nothing of this") == "nothing of this");
}

}  // namespace option_names_test
