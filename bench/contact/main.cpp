/// Error against work for scenes of contact whose solutions are known, by the methods of kte and by MuJoCo if it is
/// installed: a table for docs/contact.md.
///
///   kte_contact [--quick]      --quick: one coarse run each
#include <cstring>

#include "measure.hpp"

int main(int count, char** texts) {
  using namespace contact_bench;
  const bool quick = count > 1 && std::strcmp(texts[1], "--quick") == 0;
  std::printf("| scene | method | setting | error | evaluations or steps | ms |\n|-|-|-|-|-|-|\n");
  for (const auto& s : scenes())
    for (const auto method : {event_rows, moreau_jean_rows, mujoco_rows})
      for (const auto& r : method(s, quick)) {
        std::printf("| %s | %s | %s | %s | %lld | %s |\n", r.scene.c_str(), r.method.c_str(), r.setting.c_str(),
                    text_of(r.error, "%.1e").c_str(), r.work, text_of(1e3 * r.seconds, "%.3g").c_str());
        std::fflush(stdout);
      }
}
