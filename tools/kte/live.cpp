#include "live/run_live.hpp"

namespace kte_tool {

void add_live(command_line& line) {
  const auto o = std::make_shared<live_settings>();
  auto& c = add_reading(
      line.add("live", "simulates it in real time, in a browser",
               "Serves a page on this machine alone that shows the mechanism while it is simulated, with sliders for "
               "its motors and inputs, or without any for forces on its coordinates, and for damping. The page "
               "pauses, steps, begins anew, and records. It begins when a page is open; Ctrl-C ends it."),
      o->in);
  c.flag("--open", o->open, "opens the page in the browser, by xdg-open")
      .number("--port", "N", o->port, "where the page is served; if left out one that is free")
      .number("--speed", "X", o->speed, "seconds of the simulation in a second; 1 if left out")
      .number("--time", "S", o->end, "ends at this time of the simulation, and does not wait for a page");
  add_start(c, o->start);
  add_solver(c, o->solver).runs([o] { return run_live(*o); });
}

}  // namespace kte_tool
