#pragma once

#include <kte/io/utf8.hpp>

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

/// A text with control characters, as names of files may have them, written as \x0A, so that they do nothing to
/// terminals, and a message is a line. Lists, whose lines begin with two blanks, stay.
inline std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto length = kte::detail::utf8_length(text);
    if (length == 0 || (kte::detail::begins_with_control(text) && !text.starts_with("\n  "))) {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02X", static_cast<unsigned>(static_cast<unsigned char>(text[0])));
      out += code;
      text.remove_prefix(1);
    } else {
      out += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return out;
}

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
