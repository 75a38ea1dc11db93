#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/robots/header.hpp>

#include <sstream>

#include "evaluate/child.hpp"
#include "evaluate/program_cache.hpp"
#include "evaluate/robot_file.hpp"
#include "evaluate/runtime_model.hpp"
#include "evaluate_build.hpp"

/// Programs for one robot, whose chain is a type: written, compiled once and kept.
namespace evaluate {

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

/// The compiler and its options, as words: of $CXX, which may bring some, or of the build of this program.
inline std::vector<std::string> compiler_words() {
  std::vector<std::string> words;
  std::istringstream chosen(std::getenv("CXX") ? std::getenv("CXX") : "");
  for (std::string word; chosen >> word;) words.push_back(word);
  if (words.empty()) words.push_back(build_compiler);
  words.insert(words.end(), {"-std=c++20", "-O2"});
  words.insert(words.end(), std::begin(build_flags), std::end(build_flags));
  return words;
}

inline void compile(std::vector<std::string> words, const std::filesystem::path& folder) {
  const std::string compiler = words.front();
  words.erase(words.begin());
  words.insert(words.end(),
               {"-I" + folder.string(), "-o", (folder / "program").string(), (folder / "main.cpp").string()});
  if (const auto end = run_child(compiler, words, STDERR_FILENO, false); end.code != 0)
    throw kte::bad_argument("kte: '" + compiler + "' does not compile the program for this robot: it ended " + end.how);
}

/// Runs the program for a robot with the same arguments, which is compiled if there is none yet, or none that is whole;
/// its exit code. It is named after all that it depends on, by a hash. Throws if it does not say that it has done all.
inline int run_static(const robot_file& r, const options& o, int count, char** arguments) {
  check_frames(r.chain, o.frames);
  const auto words = compiler_words();
  const std::string header = kte::to_header(r.chain, "robot"), main = main_text(r, o);
  std::string all = header + main + time_of_build();
  for (const auto& word : words) all += '\n' + word;
  const program_cache cache(cache_folder());
  const std::string name = hash_text(all), program = cache.program(name).string();
  if (!cache.has(name)) {
    std::fprintf(stderr, "evaluate: compiling %s for this robot, once\n", program.c_str());
    cache.add(name, [&](const std::filesystem::path& folder) {
      kte::detail::replace_file(folder / "robot.hpp", header);
      kte::detail::replace_file(folder / "main.cpp", main);
      compile(words, folder);
    });
  }
  const auto end = run_child(program, {arguments + 1, arguments + count}, STDOUT_FILENO, true);
  if (!end.confirmed) throw kte::bad_file("kte: " + program + " has not done its work: it ended " + end.how);
  return end.code;
}

}  // namespace evaluate
