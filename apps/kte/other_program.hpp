#pragma once

#include "eval/child.hpp"

namespace kte_tool {

/// Runs a program of $PATH, whose standard output goes to standard error. Where it is not there, `kte::bad_file` says
/// so, with what to do then.
inline evaluate::child_end run_other(const std::string& program, const std::vector<std::string>& arguments,
                                     const std::string& otherwise) {
  try {
    return evaluate::run_child(program, arguments, STDERR_FILENO, false);
  } catch (const kte::bad_file& e) {
    throw kte::bad_file(e.what() + ("; " + otherwise));
  }
}

}  // namespace kte_tool
