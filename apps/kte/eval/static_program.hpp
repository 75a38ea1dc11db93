#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/robots/header.hpp>

#include "eval/evaluated_robot.hpp"
#include "eval/options.hpp"
#include "eval/program_cache.hpp"
#include "eval/runtime_model.hpp"
#include "eval/static_build.hpp"

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

/// Runs the program for a robot, which is compiled if there is none yet, or none that is whole; its exit code. It is
/// named after all that it depends on, by a hash. Throws if it does not say that it has done all.
inline int run_static(const evaluated_robot& r, const options& o) {
  check_frames(r.chain, o.frames);
  if (const auto& contacts = r.chain.wiring().names[static_cast<std::size_t>(kte::kind::contact)]; !contacts.empty())
    throw kte::bad_argument("kte: --static does not support rigid contacts; this chain has '" + contacts.front() + "'");
  const auto own_folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const auto words = compiler_words(own_folder / installed_library, own_folder / installed_headers);
  const std::string header = kte::to_header(r.chain, "robot"), main = main_text(r, o);
  std::string all = header + main + time_of_build("/proc/self/exe");
  for (const auto& word : words) all += '\n' + word;
  const program_cache cache(cache_folder());
  const std::string name = hash_text(all), program = cache.path_of(name).string();
  auto file = cache.find(name);
  if (file.get() < 0) {
    std::fprintf(stderr, "kte: compiling %s for this robot, once\n", program.c_str());
    cache.add(name, [&](const std::filesystem::path& folder) {
      kte::detail::replace_file(folder / "robot.hpp", header);
      kte::detail::replace_file(folder / "main.cpp", main);
      if (const auto end = compile(words, folder); end.code != 0)
        throw kte::bad_argument("kte: '" + words.front() + "' does not compile the program for this robot: it ended " +
                                end.how);
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
