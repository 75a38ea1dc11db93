/// kte: common tasks for robot files (docs/kte.md).
#include "commands.hpp"

int main(int count, char** arguments) {
  using namespace kte_tool;
  command_line line;
  for (const auto add : {add_check, add_info, add_eval, add_simulate, add_view, add_live, add_ik, add_convert,
                         add_bench, add_plot, add_help})
    add(line);
  return line.run(count, arguments);
}
