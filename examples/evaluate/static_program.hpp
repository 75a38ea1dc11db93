#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/robots/header.hpp>

#include <cstdlib>
#include <sys/wait.h>
#include <unistd.h>

#include "evaluate/robot_file.hpp"

/// Programs for one robot, whose chain is a type: written, compiled once and kept.
namespace evaluate {

inline std::string in_shell(const std::string& text) {
  std::string s = "'";
  for (const char c : text) s += c == '\'' ? "'\\''" : std::string(1, c);
  return s + "'";
}
inline int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// Where they are kept: in $XDG_CACHE_HOME, or ~/.cache, or where there is neither, among temporary files.
inline std::filesystem::path cache_folder() {
  if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
    return std::filesystem::path(cache) / "kte-evaluate";
  if (const char* const home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".cache" / "kte-evaluate";
  return std::filesystem::temp_directory_path() / "kte-evaluate";
}

/// The main function for a robot: its scalar, coordinates and frames.
inline std::string main_text(const robot_file& r, const options& o) {
  std::string s = o.digits == 50 ? "#include <boost/multiprecision/cpp_bin_float.hpp>\n" : "";
  s += "#include \"evaluate/static_main.hpp\"\n#include \"robot.hpp\"\n\nint main(int count, char** arguments) {\n"
       "  const auto& chain = robots::robot;\n  return evaluate::static_main<";
  s += o.digits == 50 ? "boost::multiprecision::cpp_bin_float_50" : "double";
  s += ">(count, arguments, chain, {";
  for (const auto& name : r.coordinates) s += kte::detail::cpp_text(name) + ", ";
  s += "}";
  for (const auto& name : o.frames) s += ", evaluate::frame_named<" + kte::detail::cpp_text(name) + ">(chain)";
  return s + ");\n}\n";
}

/// Of this program: who builds it anew may have changed the library.
inline std::string time_of_build() {
  std::error_code none;
  const auto time = std::filesystem::last_write_time("/proc/self/exe", none);
  return none ? "" : std::to_string(time.time_since_epoch().count());
}

/// Compiles the program for a robot if there is none yet, and runs it with the same arguments; its exit code. The
/// folder is named after all that the program depends on, by a hash.
inline int run_static(const robot_file& r, const options& o, int count, char** arguments) {
  const char* const chosen = std::getenv("CXX");
  const std::string compiler = chosen && *chosen ? chosen : KTE_EVALUATE_COMPILER;
  const std::string flags = std::string(" -std=c++20 -O2 ") + KTE_EVALUATE_FLAGS;
  const std::string header = kte::to_header(r.chain, "robot"), main = main_text(r, o);
  char name[20];
  std::snprintf(name, sizeof name, "%016llx",
                static_cast<unsigned long long>(kte::detail::hash(header + main + compiler + flags + time_of_build())));
  const auto folder = cache_folder() / name;
  const auto program = folder / "program";
  if (!std::filesystem::exists(program)) {
    std::filesystem::create_directories(folder);
    kte::detail::replace_file(folder / "robot.hpp", header);
    kte::detail::replace_file(folder / "main.cpp", main);
    const auto part = folder / ("program." + std::to_string(getpid()));  // complete when it gets its name
    std::fprintf(stderr, "evaluate: compiling %s for this robot, once\n", program.c_str());
    if (run(compiler + flags + " -I" + in_shell(folder) + " -o " + in_shell(part) + " " +
            in_shell(folder / "main.cpp")) != 0)
      throw kte::bad_argument("kte: '" + compiler + "' does not compile " + (folder / "main.cpp").string());
    std::filesystem::rename(part, program);
  }
  std::string command = in_shell(program);
  for (int i = 1; i < count; ++i) command += " " + in_shell(arguments[i]);
  return run(command);
}

}  // namespace evaluate
