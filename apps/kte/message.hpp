#pragma once

#include <kte/io/printable.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "command_line.hpp"
#include "option_names.hpp"

/// What the program says on standard error.
namespace kte_tool {

using kte::detail::printable;

/// `printable` for a text of several lines.
inline std::string printable_lines(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    out += printable(text.substr(0, end)) + '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

/// "kte: " and a text, as a line of standard error.
inline void say(std::string_view text) {
  if (text.starts_with("kte: ")) text.remove_prefix(5);
  std::fprintf(stderr, "kte: %s\n", printable(with_option_names(text)).c_str());
}

/// The exit code of f(), or what is thrown, as a line of standard error: then it is 1. `usage_error` goes on.
template <class F>
int exit_code_of(const F& f) {
  try {
    return f();
  } catch (const usage_error&) {
    throw;
  } catch (const std::bad_alloc&) {
    say("not enough memory");
  } catch (const std::exception& e) {
    say(e.what());
  }
  return 1;
}

}  // namespace kte_tool
