/// The headers that `write` wrote hold the same models: every type of element, with equal names and numbers.
#include <kte/runtime_chain/static_chain_map.hpp>
#include <kte/static.hpp>

#include <cassert>
#include <cstdio>

#include "header/models.hpp"

// As the headers of Windows and of some other systems have them, behind those of the library.
#define small char
#define near
#define far
#define interface struct
#define IN
#define ERROR 0
#define major(x) x

namespace robots {  // names that would hide others
struct kte;
struct std;
}  // namespace robots

#include "headers.hpp"
#if __has_include("arm_of_file.hpp")
#  include "arm_of_file.hpp"
static_assert(robots::arm_of_file_limits.lower.size() == 7 && robots::arm_of_file.dofs == 7);
#endif

static_assert(robots::macros_names::a_3_.name == "a " && robots::macros_names::x_y_.name == "x - y");

int main() {
  int failures = 0;
  const auto models = header_models::all();
  std::size_t count = 0;
  for_each_robot([&](const std::string& name, const auto& chain) {
    ++count;
    if (record_of(chain) == models.at(name)) return;
    ++failures;
    std::printf("%s is another model in its header\n", name.c_str());
  });
  std::printf("%zu headers, %d of them not their models\n", count, failures);
  return failures != 0 || count != models.size();
}
