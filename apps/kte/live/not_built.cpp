#include "live/run_live.hpp"

namespace kte_tool {

int run_live(const live_settings&) {
  throw kte::bad_argument(
      "kte: kte live needs cpp-httplib (Debian: libcpp-httplib-dev), which was not there when this "
      "program was built");
}

}  // namespace kte_tool
