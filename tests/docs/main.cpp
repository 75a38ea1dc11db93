/// Runs every snippet of the documentation: each must print what its page says.
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <unistd.h>

#include "docs/snippet.hpp"

namespace {

/// Standard output goes to a file while this lives.
class capture {
 public:
  capture() : file_(std::tmpfile()), terminal_(dup(STDOUT_FILENO)) {
    flush();
    dup2(fileno(file_), STDOUT_FILENO);
  }
  ~capture() {
    flush();
    dup2(terminal_, STDOUT_FILENO);
    close(terminal_);
    std::fclose(file_);
  }
  std::string text() const {
    flush();
    std::string all;
    std::rewind(file_);
    for (int c; (c = std::fgetc(file_)) != EOF;) all += static_cast<char>(c);
    return all;
  }
  capture(const capture&) = delete;
  capture& operator=(const capture&) = delete;

 private:
  static void flush() {
    std::cout.flush();
    std::fflush(stdout);
  }
  std::FILE* file_;
  int terminal_;
};

std::string printed_by(const docs::snippet& s) {
  const capture c;
  try {
    s.run();
  } catch (const std::exception& e) {
    return c.text() + "(exception) " + e.what() + "\n";
  }
  return c.text();
}

}  // namespace

int main() {
  int failures = 0;
  for (const auto& s : docs::snippet::all()) {
    const std::string printed = printed_by(s);
    if (printed == s.prints) continue;
    ++failures;
    std::printf("%s prints\n%sThe page says\n%s\n", s.where, printed.c_str(), s.prints);
  }
  std::printf("%zu snippets, %d print something else than the page says\n", docs::snippet::all().size(), failures);
  return failures != 0 || docs::snippet::all().empty();
}
