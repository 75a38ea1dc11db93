#pragma once

#include "command_line.hpp"

/// The subcommands, each declared and done in its own file.
namespace kte_tool {

void add_check(command_line& line);
void add_info(command_line& line);
void add_eval(command_line& line);
void add_simulate(command_line& line);
void add_view(command_line& line);
void add_live(command_line& line);
void add_ik(command_line& line);
void add_convert(command_line& line);
void add_bench(command_line& line);
void add_plot(command_line& line);
void add_help(command_line& line);

}  // namespace kte_tool
