/// A mechanism that turns by a slider, for live_test.py: prints its address, what the slider says, and what is pulled,
/// and ends with its input, or after two minutes.
#include <kte/kte.hpp>
#include <kte/view/live_page.hpp>

#include <cmath>
#include <cstdio>
#include <poll.h>
#include <thread>

namespace {
inline constexpr struct q_ final : kte::coord_key<"q"> {
} q;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {
} base;
inline constexpr struct joint_ final : kte::frame_2D_key<"joint"> {
} joint;
inline constexpr struct tip_ final : kte::frame_2D_key<"tip"> {
} tip;

kte::page_pull hand;
constexpr auto arm =
    kte::chain(kte::revolute_joint_2D(q, base, joint), kte::rigid_link_2D(joint, tip, kte::along_x(1.0)),
               kte::inertia_2D(tip, kte::point_mass(1.0)), kte::pull_2D(joint, hand))
        .gravity(kte::along_y(-9.81));

void print(const kte::page_pull& p) {
  if (p.frame.empty()) return void(std::printf("released\n"));
  std::printf("pull %s at %.3f %.3f to %.3f %.3f\n", p.frame.c_str(), p.point.x, p.point.y, p.target.x, p.target.y);
}

/// Stops a page at the end of the input, or after two minutes.
void stop_in_time(kte::live_server& page) {
  pollfd p{0, POLLIN, 0};
  ::poll(&p, 1, 120'000);
  page.stop();
}
}  // namespace

int main() {
  kte::live_page page(arm, {.title = "Live </script> arm"});
  page.slider("angle </script>", -1, 1, 0, "rad");
  std::printf("%s\n", page.url().c_str());
  auto s = kte::make_state(arm);
  double t = 0, angle = 0;
  int resets = 0;
  std::thread watch([&page] { stop_in_time(page); });
  for (; page.wait(t); t += 0.01) {
    if (page.reset()) t = 0, std::printf("reset %d\n", ++resets);
    if (const double now = page.value("angle </script>"); now != angle) std::printf("angle %g\n", angle = now);
    if (const auto now = page.pull(); now.frame != hand.frame || now.target != hand.target) print(hand = now);
    std::fflush(stdout);
    s[q].q = angle + 0.5 * std::sin(3 * t);
    arm.doMotion(s);
    page.show(t, s);
  }
  watch.join();
}
