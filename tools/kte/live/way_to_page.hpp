#pragma once

#include <kte/io/replace_file.hpp>

#include <cstdlib>

namespace kte_tool {

/// A file that leads a browser to an address, in a folder that only its user can read: on a command line all users of
/// the machine would see the address, and its token. It is removed at the end.
class way_to_page {
 public:
  explicit way_to_page(const std::string& url) {
    auto name = (std::filesystem::temp_directory_path() / "kte-live-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) kte::detail::raise_file("make", name, errno);
    folder_ = name;
    kte::detail::replace_file(file(), "<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url=" + url +
                                          "\"><title>kte live</title><a href=\"" + url + "\">the page</a>\n");
  }
  way_to_page(const way_to_page&) = delete;
  ~way_to_page() {
    std::error_code none;
    std::filesystem::remove_all(folder_, none);
  }
  std::filesystem::path file() const { return folder_ / "live.html"; }

 private:
  std::filesystem::path folder_;
};

}  // namespace kte_tool
