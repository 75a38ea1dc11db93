#pragma once

#include <sstream>

#include "eval/child.hpp"
#include "eval_build.hpp"

/// Compiles a program or library for one robot.
namespace evaluate {

/// The time of the build of a program or module, which may have been built again with another library.
inline std::string time_of_build(const std::filesystem::path& file) {
  std::error_code none;
  const auto time = std::filesystem::last_write_time(file, none);
  return none ? "" : std::to_string(time.time_since_epoch().count());
}

/// The compiler and its options, as words: of $CXX, which may bring some, or of the build of this program. Headers are
/// those of `library` and `own`, if they are installed there, or else those in the sources.
inline std::vector<std::string> compiler_words(const std::filesystem::path& library, const std::filesystem::path& own) {
  std::vector<std::string> words;
  std::istringstream chosen(std::getenv("CXX") ? std::getenv("CXX") : "");
  for (std::string word; chosen >> word;) words.push_back(word);
  std::error_code none;
  if (words.empty()) words.push_back(std::filesystem::exists(build_compiler, none) ? build_compiler : "c++");
  words.insert(words.end(), {"-std=c++20", "-O2"});
  if (std::filesystem::exists(library / "kte/kte.hpp", none) &&
      std::filesystem::exists(own / "eval/frame_named.hpp", none))
    words.insert(words.end(), {"-I" + library.lexically_normal().string(), "-I" + own.lexically_normal().string()});
  else
    words.insert(words.end(), {std::string("-I") + source_library, std::string("-I") + source_headers});
  words.insert(words.end(), std::begin(build_flags), std::end(build_flags));
  return words;
}

/// Compiles main.cpp of a folder to `program`; messages go to the file `messages`. `watch` as for `run_child`.
inline child_end compile(std::vector<std::string> words, const std::filesystem::path& folder,
                         int messages = STDERR_FILENO, const std::function<void()>& watch = {}) {
  const std::string compiler = words.front();
  words.erase(words.begin());
  words.insert(words.end(),
               {"-I" + folder.string(), "-o", (folder / "program").string(), (folder / "main.cpp").string()});
  return run_child(compiler, words, messages, false, -1, messages, watch);
}

}  // namespace evaluate
