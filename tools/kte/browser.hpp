#pragma once

#include "eval/child.hpp"

namespace kte_tool {

/// Opens a file in the browser that the desktop has for it. Throws `kte::bad_file` where that does not work.
inline void open_in_browser(const std::filesystem::path& file) {
  const auto page = std::filesystem::absolute(file).string();
  const auto end = [&page] {
    try {
      return evaluate::run_child("xdg-open", {page}, STDERR_FILENO, false);
    } catch (const kte::bad_file& e) {
      throw kte::bad_file(std::string(e.what()) +
                          "; it finds the browser (Debian: xdg-utils), which may open the page by hand");
    }
  }();
  if (end.code != 0) throw kte::bad_file("kte: xdg-open did not open '" + page + "': it ended " + end.how);
}

}  // namespace kte_tool
