#pragma once

#include <kte/errors.hpp>
#include <kte/io/file.hpp>
#include <kte/io/printable.hpp>

#include <new>

/// Functions for command line programs.
namespace kte::detail {

/// Writes a text to standard output at once. Throws `bad_file` with the reason if this fails.
inline void write_standard_output(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    raise<bad_file>(std::string("kte: cannot write to standard output: ") + std::strerror(errno));
}

/// The exit code of f(). If f throws, writes the message to standard error and returns 1.
template <class F>
int exit_code_of(const F& f) {
  try {
    return f();
  } catch (const std::bad_alloc&) {
    std::fputs("kte: not enough memory\n", stderr);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", printable(e.what()).c_str());
  }
  return 1;
}

}  // namespace kte::detail
