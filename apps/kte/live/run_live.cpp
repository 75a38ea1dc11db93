#include "live/run_live.hpp"

#include <kte/io/program.hpp>
#include <kte/models/modes.hpp>

#include <cmath>
#include <set>

#include "browser.hpp"
#include "live/hand_inputs.hpp"
#include "live/interruption.hpp"
#include "live/way_to_page.hpp"
#include "message.hpp"
#include "simulate/motors.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {

constexpr double frame = 0.01;  // s of a clock between states that are shown

void check_settings(const live_settings& o) {
  const auto refuse = [](const std::string& what, double x) { throw usage_error(what + ", not " + short_number(x)); };
  if (!(o.port >= 0 && o.port <= 65535) || o.port != std::floor(o.port))
    refuse("--port is a number up to 65535", o.port);
  if (!(o.speed >= 1e-3 && o.speed <= 1e3)) refuse("--speed is between 0.001 and 1000", o.speed);
  check_settings(o.solver), check_contacts(o.in);
  if (o.end && !(*o.end > 0)) refuse("--time must be greater than 0", *o.end);
}

/// The page is there without a browser, too.
void open_if_possible(const std::filesystem::path& page) {
  try {
    open_in_browser(page);
  } catch (const kte::bad_file& e) {
    say(e.what());
  }
}

}  // namespace

int run_live(const live_settings& o) {
  check_settings(o);
  auto m = read_and_warn(o.in, true);
  if (!m.robot.actuators.empty()) take_motors(m);
  if (m.chain().dofs() == 0) throw kte::bad_argument("kte: " + m.file + " has no degrees of freedom: nothing can move");
  kte::page_pull hand;
  driven_chain driven(m.chain());
  driven.chain = kte::with_pulls(std::move(driven.chain), hand);
  std::optional<hand_inputs> inputs;
  plant p(
      driven.chain, [&](double, const plant::state& x, Eigen::VectorXd& u) { inputs->put(x, driven.chain.nq(), u); },
      false);
  if (m.model) kte::detail::restore_inputs(*m.model, p.model());
  const initial_state at_start(o.start, m, driven.chain);
  inputs.emplace(m, driven, p.model(), at_start.q);
  const plant::state start = kte::settled(p.model(), 0.0, p.model().make_x(at_start.q, at_start.v));
  auto solver = make_solver(p, start, o.solver);

  kte::robot shown = m.robot;  // with shapes; its states are those of the chain that is simulated
  shown.chain = driven.chain;
  interruption interrupted;
  kte::live_page page(shown,
                      {.title = m.robot.name.empty() ? std::filesystem::path(m.file).stem().string() : m.robot.name,
                       .port = static_cast<int>(o.port),
                       .speed = o.speed});
  inputs->show(page);
  interrupted.calls([&page] { page.stop(); });
  kte::detail::write_standard_output(page.url() + '\n');
  say("the page is at the address above, for everyone who knows it; Ctrl-C ends");
  std::optional<way_to_page> way;
  if (o.open) open_if_possible(way.emplace(page.url()).file());

  page.show(0, solver->state_at(0, start));
  if (!o.end && !page.wait_for_page()) return 0;
  while (page.wait(solver->time())) {
    if (o.end && solver->time() >= *o.end) break;
    if (page.reset()) {
      solver = make_solver(p, start, o.solver);
      page.show(0, solver->state_at(0, start));
      continue;
    }
    inputs->take(page);
    hand = page.pull();
    try {
      const double step = frame * page.speed(), next = solver->time() + step;
      solver->advance(o.end ? std::min(next, *o.end) : next, kte::every(step), [](double, const plant::state&) {});
      page.show(solver->time(), solver->state_at(solver->time(), solver->state()));
    } catch (const kte::error& e) {
      say(e.what());
      page.say(with_option_names(e.what()));
      page.pause();
    }
  }
  return 0;
}

}  // namespace kte_tool
