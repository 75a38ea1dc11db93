#pragma once

#include <kte/io/replace_file.hpp>

#include "private_folder.hpp"

namespace kte_tool {

/// A file that leads a browser to an address, in a private folder: on a command line all users of the machine would
/// see the address, and its token. It is removed at the end.
class way_to_page {
 public:
  explicit way_to_page(const std::string& url) : folder_("kte-live") {
    kte::detail::replace_file(file(), "<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url=" + url +
                                          "\"><title>kte live</title><a href=\"" + url + "\">the page</a>\n");
  }
  std::filesystem::path file() const { return folder_.path() / "live.html"; }

 private:
  private_folder folder_;
};

}  // namespace kte_tool
