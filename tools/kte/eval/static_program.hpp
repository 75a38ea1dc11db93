#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/robots/header.hpp>

#include <sstream>

#include "eval/child.hpp"
#include "eval/evaluated_robot.hpp"
#include "eval/options.hpp"
#include "eval/program_cache.hpp"
#include "eval/runtime_model.hpp"
#include "eval_build.hpp"

/// Programs for one robot, whose chain is a type: written, compiled once and kept.
namespace evaluate {

/// The main function for a robot: its scalar, coordinates and frames.
inline std::string main_text(const evaluated_robot& r, const options& o) {
  std::string s = o.digits == 50 ? "#include <boost/multiprecision/cpp_bin_float.hpp>\n" : "";
  s += "#include \"eval/static_main.hpp\"\n#include \"robot.hpp\"\n\nint main(int count, char** arguments) {\n"
       "  const auto& chain = robots::robot;\n  return evaluate::static_main<";
  s += o.digits == 50 ? "boost::multiprecision::cpp_bin_float_50" : "double";
  s += ">(count, arguments, chain, {";
  for (const auto& name : r.coordinates) s += kte::detail::cpp_text(name) + ", ";
  s += "}";
  for (const auto& name : o.frames) s += ", evaluate::frame_named<" + kte::detail::cpp_text(name) + ">(chain)";
  return s + ");\n}\n";
}

/// Of this program: who builds it again may have changed the library.
inline std::string time_of_build() {
  std::error_code none;
  const auto time = std::filesystem::last_write_time("/proc/self/exe", none);
  return none ? "" : std::to_string(time.time_since_epoch().count());
}

/// Where the library and these headers are: beside this program, if it is installed, or else in the sources.
inline std::vector<std::string> header_folders() {
  std::error_code none;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  const auto library = here / installed_library, own = here / installed_headers;
  if (std::filesystem::exists(library / "kte/kte.hpp", none) &&
      std::filesystem::exists(own / "eval/static_main.hpp", none))
    return {"-I" + library.lexically_normal().string(), "-I" + own.lexically_normal().string()};
  return {std::string("-I") + source_library, std::string("-I") + source_headers};
}

/// The compiler and its options, as words: of $CXX, which may bring some, or of the build of this program.
inline std::vector<std::string> compiler_words() {
  std::vector<std::string> words;
  std::istringstream chosen(std::getenv("CXX") ? std::getenv("CXX") : "");
  for (std::string word; chosen >> word;) words.push_back(word);
  if (words.empty()) words.push_back(build_compiler);
  words.insert(words.end(), {"-std=c++20", "-O2"});
  const auto headers = header_folders();
  words.insert(words.end(), headers.begin(), headers.end());
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

/// Runs the program for a robot, which is compiled if there is none yet, or none that is whole; its exit code. It is
/// named after all that it depends on, by a hash. Throws if it does not say that it has done all.
inline int run_static(const evaluated_robot& r, const options& o) {
  check_frames(r.chain, o.frames);
  const auto words = compiler_words();
  const std::string header = kte::to_header(r.chain, "robot"), main = main_text(r, o);
  std::string all = header + main + time_of_build();
  for (const auto& word : words) all += '\n' + word;
  const program_cache cache(cache_folder());
  const std::string name = hash_text(all), program = cache.path_of(name).string();
  auto file = cache.find(name);
  if (file.get() < 0) {
    std::fprintf(stderr, "kte: compiling %s for this robot, once\n", program.c_str());
    cache.add(name, [&](const std::filesystem::path& folder) {
      kte::detail::replace_file(folder / "robot.hpp", header);
      kte::detail::replace_file(folder / "main.cpp", main);
      compile(words, folder);
    });
    file = cache.find(name);
    if (file.get() < 0) throw kte::bad_file("kte: " + program + " was damaged right after it was written");
  }
  const auto end =
      run_child(program, {o.states.string(), o.ops, o.derivatives ? "1" : "0"}, STDOUT_FILENO, true, file.get());
  if (!end.confirmed) throw kte::bad_file("kte: " + program + " failed: it ended " + end.how);
  return end.code;
}

}  // namespace evaluate
