#pragma once

#include "other_program.hpp"

namespace kte_tool {

/// Opens a file in the browser that the desktop has for it. Throws `kte::bad_file` where that does not work.
inline void open_in_browser(const std::filesystem::path& file) {
  const auto page = std::filesystem::absolute(file).string();
  const auto end = run_other("xdg-open", {page}, "install it (Debian: xdg-utils), or open the page in a browser");
  if (end.code != 0) throw kte::bad_file("kte: xdg-open did not open '" + page + "': it ended " + end.how);
}

}  // namespace kte_tool
