// What a user of kte::view writes: a page of a pendulum; and of kte::live, whose page ends at once.
#include <kte/kte.hpp>
#include <kte/view.hpp>
#ifdef WITH_LIVE
#  include <kte/view/live_page.hpp>
#endif

#include <cstdio>
#include <fstream>
#include <iterator>

int main() {
  kte::runtime_chain pendulum;
  pendulum << kte::revolute_joint_2D("q", "base", "arm") << kte::inertia_2D("arm", kte::point_mass(2.0));
  kte::write_page("pendulum.html", pendulum, {.title = "Consumer"});
  std::ifstream in("pendulum.html");
  const std::string page(std::istreambuf_iterator<char>(in), {});
  std::remove("pendulum.html");
  bool good = page.find(R"("title":"Consumer")") != page.npos;
#ifdef WITH_LIVE
  kte::live_page live(pendulum, {.title = "Consumer"});
  live.slider("torque", -5, 5, 1, "N m");
  auto s = pendulum.make_state();
  for (double t = 0; t < 0.05 && live.wait(t); t += 0.01) {
    pendulum.doMotion(s);
    live.show(t, s);
  }
  live.stop();
  good = good && live.url().starts_with("http://127.0.0.1:") && live.value("torque") == 1 && !live.wait(1);
#endif
  return good ? 0 : 1;
}
