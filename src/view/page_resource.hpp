#pragma once

#include <string_view>

namespace kte::view {

/// The page that shows scenes (share/kte/page.html), as it is in the library.
std::string_view page_resource();

}  // namespace kte::view
