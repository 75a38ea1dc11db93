/// A mechanism that turns by a slider, for live_test.py: prints its address and what the slider says, and ends with its
/// input, or after two minutes.
#include <kte/kte.hpp>
#include <kte/view/live_page.hpp>

#include <poll.h>

#include <cmath>
#include <cstdio>

namespace {
inline constexpr struct q_ final : kte::coord_key<"q"> {} q;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {} base;
inline constexpr struct joint_ final : kte::frame_2D_key<"joint"> {} joint;
inline constexpr struct tip_ final : kte::frame_2D_key<"tip"> {} tip;

constexpr auto arm = kte::chain(kte::revolute_joint_2D(q, base, joint), kte::rigid_link_2D(joint, tip, kte::along_x(1.0)),
                                kte::inertia_2D(tip, kte::point_mass(1.0)))
                         .gravity(kte::along_y(-9.81));

bool input_ended() {
  pollfd p{0, POLLIN, 0};
  char byte = 0;
  return ::poll(&p, 1, 0) > 0 && std::fread(&byte, 1, 1, stdin) == 0;
}
}  // namespace

int main() {
  kte::live_page page(arm, {.title = "Live </script> arm"});
  page.slider("angle </script>", -1, 1, 0, "rad");
  std::printf("%s\n", page.url().c_str());
  auto s = kte::make_state(arm);
  double t = 0, angle = 0;
  int resets = 0;
  for (int i = 0; i < 12000 && !input_ended(); ++i) {
    if (page.reset()) t = 0, std::printf("reset %d\n", ++resets);
    if (const double now = page.value("angle </script>"); now != angle) std::printf("angle %g\n", angle = now);
    s[q].q = angle + 0.5 * std::sin(3 * t);
    arm.doMotion(s);
    page.show(t, s);
    std::fflush(stdout);
    if (page.paused()) {
      const timespec a_while{0, 10'000'000};
      nanosleep(&a_while, nullptr);
    } else {
      page.wait(t += 0.01);
    }
  }
}
