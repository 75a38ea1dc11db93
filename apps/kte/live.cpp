#include "live/run_live.hpp"

namespace kte_tool {

void add_live(command_line& line) {
  const auto o = std::make_shared<live_settings>();
  auto& c = add_reading(
      line.add("live", "simulates it in real time in a browser",
               "Serves a page, on this machine only, that shows the mechanism while it is simulated. The page has "
               "sliders for motors and inputs, or otherwise for forces on coordinates, and one for damping. It can "
               "pause, step, restart and record. The simulation starts when a page is open; Ctrl-C ends it."),
      o->in);
  c.flag("--open", o->open, "opens the page in the browser with xdg-open")
      .number("--port", "N", o->port, "port of the page; default: any free port")
      .number("--speed", "X", o->speed, "simulated seconds per second; default 1")
      .number("--time", "S", o->end, "ends at this simulated time, and does not wait for a page");
  add_start(c, o->start);
  add_contacts(c, o->in);
  add_solver(c, o->solver).runs([o] { return run_live(*o); });
}

}  // namespace kte_tool
