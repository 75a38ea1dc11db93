// What a user of kte::view writes: a page of a pendulum.
#include <kte/kte.hpp>
#include <kte/view.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>

int main() {
  kte::kte_map_chain pendulum;
  pendulum << kte::revolute_joint_2D("q", "base", "arm") << kte::inertia_2D("arm", kte::point_mass(2.0));
  kte::write_page("pendulum.html", pendulum, {.title = "Consumer"});
  std::ifstream in("pendulum.html");
  const std::string page(std::istreambuf_iterator<char>(in), {});
  std::remove("pendulum.html");
  return page.find(R"("title":"Consumer")") != page.npos ? 0 : 1;
}
