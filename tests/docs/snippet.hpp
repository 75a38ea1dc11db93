#pragma once

#include <cassert>
#include <vector>

/// What the pages of the documentation show, as functions: snippets.awk.
namespace docs {

struct snippet {
  const char* where;  ///< "README.md:12"
  void (*run)();
  const char* prints;

  snippet(const char* at, void (*function)(), const char* output) : where(at), run(function), prints(output) {
    all().push_back(*this);
  }
  static std::vector<snippet>& all() {
    static std::vector<snippet> list;
    return list;
  }
};

}  // namespace docs
