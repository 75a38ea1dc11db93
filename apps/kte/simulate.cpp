#include <kte/dynamics/energy.hpp>
#include <kte/io/model_inputs.hpp>
#include <kte/io/program.hpp>
#include <kte/io/progress.hpp>
#include <kte/io/progress_bar.hpp>
#include <kte/io/table_format.hpp>
#include <kte/models/modes.hpp>

#include <chrono>

#include "commands.hpp"
#include "json_writer.hpp"
#include "output_file.hpp"
#include "simulate/law.hpp"
#include "simulate/motors.hpp"
#include "simulate/recording_file.hpp"
#include "simulate/solvers.hpp"
#include "start.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {

struct simulate_options {
  reading in;
  double end = 10, every = 0.01;  ///< s
  start_options start;
  solver_options solver;
  std::string pd, input, record;
  std::vector<std::string> columns;
  std::optional<double> kp, kd;
  bool motors = false, compensate = false, frames = false, event_rows = false, events = false, json = false;
};

struct summary {
  kte::step_statistics steps;
  long long events = 0;
  std::vector<past_event> event_list;
  double seconds = 0;
  kte::energies<> before, after;
  Eigen::VectorXd q, v;
  std::size_t rows = 0;
  std::string control;
};

double total(const kte::energies<>& e) { return e.kinetic + e.potential; }

std::string text_of(const simulate_options& o, const mechanism& m, const summary& s) {
  const auto& n = s.steps;
  const auto energy = [](const char* when, const kte::energies<>& e) {
    return std::string("energy at the ") + when + ": " + short_number(total(e)) + " J, kinetic " +
           short_number(e.kinetic) + ", potential " + short_number(e.potential) + '\n';
  };
  std::string t =
      printable(m.file) + ": " + short_number(o.end) + " s by " + o.solver.name + ", " + std::to_string(n.steps) +
      " steps, " + std::to_string(n.rejected) + " rejected, " + std::to_string(n.evaluations) + " evaluations" +
      (s.events ? ", " + std::to_string(s.events) + " events" : "") + ", " + short_number(s.seconds) + " s of time\n";
  t += s.control;
  t += energy("start", s.before) + energy("end", s.after);
  t += "change of energy: " + short_number(total(s.after) - total(s.before)) + " J\n";
  if (!o.record.empty()) t += std::to_string(s.rows) + " rows in " + printable(o.record) + '\n';
  char digits[64];
  if (o.events) t += "events\n";
  for (const auto& e : s.event_list) {
    std::snprintf(digits, sizeof digits, "  %.12g s: ", e.time);
    t += digits + e.element + (e.what.empty() ? "" : ": " + e.what) + '\n';
  }
  t += "state at the end\n";
  for (const auto& e : kte::layout(m.chain())) {
    t += "  " + e.name + ": q";
    for (int i = e.q; i < e.q + e.nq; ++i) std::snprintf(digits, sizeof digits, " %.12g", s.q[i]), t += digits;
    t += ", v";
    for (int i = e.v; i < e.v + e.nv; ++i) std::snprintf(digits, sizeof digits, " %.12g", s.v[i]), t += digits;
    t += '\n';
  }
  return t;
}

std::string json_of(const simulate_options& o, const mechanism& m, const summary& s) {
  const auto list = [](const Eigen::VectorXd& x) { return std::vector<double>(x.data(), x.data() + x.size()); };
  const auto& n = s.steps;
  json_writer j;
  j.object().member("file", m.file).member("solver", o.solver.name).member("time", o.end);
  j.member("tolerance", o.solver.tolerance).member("step", o.solver.step);
  j.member("steps", n.steps).member("rejected", n.rejected).member("evaluations", n.evaluations);
  j.member("events", s.events).member("seconds", s.seconds);
  if (o.events) {
    j.key("event_list").list();
    for (const auto& e : s.event_list)
      j.object().member("time", e.time).member("element", e.element).member("what", e.what).end();
    j.end();
  }
  const auto energy = [&j](const char* name, const kte::energies<>& e) {
    j.key(name).object().member("kinetic", e.kinetic).member("potential", e.potential).member("total", total(e)).end();
  };
  energy("energy_at_start", s.before), energy("energy_at_end", s.after);
  if (!o.record.empty()) j.member("recording", o.record).member("rows", s.rows);
  j.key("coordinates").list();
  for (const auto& e : kte::layout(m.chain())) j.value(e.name);
  return j.end().member("q", list(s.q)).member("v", list(s.v)).end().text();
}

void check_settings(const simulate_options& o) {
  const auto positive = [](const char* name, double x) {
    if (!(x > 0)) throw usage_error(std::string(name) + " must be greater than 0, not " + short_number(x));
  };
  positive("--time", o.end), positive("--every", o.every), check_settings(o.solver);
  constexpr double most_rows = 1e8;
  if (!o.record.empty() && o.end / o.every > most_rows)
    throw usage_error("a recording has " + short_number(most_rows) + " rows at most: --every " + short_number(o.every) +
                      " of --time " + short_number(o.end) + " are more");
  check_contacts(o.in);
  if (o.pd.empty() && (o.kp || o.kd || o.compensate)) throw usage_error("--kp, --kd and --compensate need --pd");
  for (const auto& [name, gain] : {std::pair{"--kp", o.kp}, std::pair{"--kd", o.kd}})
    if (gain && !(*gain >= 0))
      throw usage_error(std::string(name) + " must not be negative, not " + short_number(*gain));
  if (o.record.empty() && (!o.columns.empty() || o.frames || o.event_rows))
    throw usage_error("--column, --frames and --event-rows need --record");
  if (!o.record.empty()) (void)kte::format_of(o.record);  // before what takes long
  refuse_input_as_output({"--record", o.record},
                         {{"FILE", o.in.file}, {"--start", o.start.table}, {"--pd", o.pd}, {"--input", o.input}});
}

/// What drives the mechanism.
struct drives {
  std::optional<pd_control> pd;
  std::optional<input_table> inputs;
  Eigen::VectorXd constant;  ///< inputs that the model file has
};

int simulate(simulate_options& o) {
  check_settings(o);
  auto m = read_and_warn(o.in, o.motors);
  refuse_file_of_robot_as_output({"--record", o.record}, m, o.in);
  if (o.motors) {
    if (m.model) throw kte::bad_argument("kte: --motors is for robot files; a model file contains its motors");
    take_motors(m);
  }
  if (m.chain().dofs() == 0) throw kte::bad_argument("kte: " + m.file + " has no degrees of freedom: nothing can move");

  const initial_state start(o.start, m, m.chain());
  std::vector<std::string> force_of(static_cast<std::size_t>(m.chain().dofs()));
  auto chain = m.chain();
  if (!o.pd.empty() || !o.input.empty()) {
    const driven_chain driven(m.chain());
    chain = driven.chain, force_of = driven.force_of;
  }
  drives d;
  const auto law = [&d, nq = chain.nq()](double t, const plant::state& x, Eigen::VectorXd& u) {
    u = d.constant;
    if (d.inputs) d.inputs->put_inputs(t, u);
    if (d.pd) d.pd->put_forces(t, x, nq, u);
  };
  const bool has_law = !o.pd.empty() || !o.input.empty();
  plant p(chain, has_law ? plant::law(law) : nullptr, o.pd.empty());
  if (m.model) kte::detail::restore_inputs(*m.model, p.model());
  d.constant = p.model().input();
  summary s;
  if (!o.input.empty()) d.inputs.emplace(evaluate::state_table(o.input), m, p.model(), force_of);
  std::optional<evaluate::state_table> targets;
  if (!o.pd.empty()) {
    targets.emplace(o.pd);
    d.pd.emplace(*targets, m, m.chain(), o.compensate);
    const auto masses = d.pd->largest_masses(start.q);
    s.control = "PD control";
    for (const auto& e : kte::layout(m.chain())) {
      if (e.nv != 1) continue;
      const double felt = masses[e.v], kp = o.kp.value_or(100 * felt), kd = o.kd.value_or(20 * felt);
      const auto before = d.pd->joints().size();
      d.pd->add({e.name, e.q, e.v, place_of_input(p.model(), force_of[static_cast<std::size_t>(e.v)]), kp, kd,
                 m.robot.limits.effort[static_cast<std::size_t>(e.v)]});
      if (d.pd->joints().size() > before)
        s.control += (before ? ", '" : ": '") + e.name + "' " + short_number(kp) + " and " + short_number(kd);
    }
    if (d.pd->joints().empty()) throw kte::bad_file("kte: " + o.pd + ":1: has no target of a coordinate of one number");
    s.control += " (N/m or Nm/rad, and their rates)";
    std::string free;
    for (const auto& e : kte::layout(m.chain()))
      if (e.nv == 1 &&
          std::none_of(d.pd->joints().begin(), d.pd->joints().end(), [&](const auto& j) { return j.v == e.v; }))
        free += (free.empty() ? "; no target for '" : "', '") + e.name;
    s.control += (free.empty() ? "" : free + "'") + "\n";
  }

  const auto energy_at = [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    auto state = chain.make_state();
    return kte::energy(chain, state, q, v);
  };
  s.before = energy_at(start.q, start.v);
  plant::state x = p.make_x(0, start.q, start.v);
  p.set_inputs(0, x);
  x = kte::settled(p.model(), 0.0, x);
  std::optional<recording_file> out;
  auto columns = o.columns;
  const auto& always = kte::detail::energy_names;
  std::erase_if(columns,
                [&](const auto& name) { return std::find(always.begin(), always.end(), name) != always.end(); });
  if (o.frames)
    for (const auto k : {kte::kind::frame_2D, kte::kind::frame_3D})
      for (const auto& name : chain.wiring().names[static_cast<std::size_t>(k)]) columns.push_back("frame:" + name);
  if (!o.record.empty()) out.emplace(o.record, m, chain, columns);
  const auto began = std::chrono::steady_clock::now();
  try {
    const auto solver = make_solver(p, x, o.solver);
    if (o.events) solver->keep_events();
    kte::progress report(0.0, o.end, kte::progress_bar());
    const kte::every rows(o.every);
    solver->advance(o.end, o.event_rows ? rows.with_event_rows() : rows, [&](double t, const plant::state& at) {
      if (out) out->row(t, chain, solver->state_at(t, at));
      report(t);
    });
    x = solver->state(), s.steps = solver->statistics(), s.events = solver->events();
    s.event_list = solver->kept_events();
  } catch (...) {
    if (out) out->close();  // what there was until then
    throw;
  }
  s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (out) out->close(), s.rows = out->rows();
  s.q = p.model().positions_of(x), s.v = p.model().velocities_of(x);
  s.after = energy_at(s.q, s.v);
  kte::detail::write_standard_output(o.json ? json_of(o, m, s) : printable_lines(text_of(o, m, s)));
  return 0;
}

}  // namespace

void add_simulate(command_line& line) {
  const auto o = std::make_shared<simulate_options>();
  auto& c = add_reading(line.add("simulate", "simulates it and records the motion",
                                 "Integrates the equations of motion, under gravity alone or with control, and prints "
                                 "energies and the final state. A terminal shows a progress bar."),
                        o->in);
  c.number("--time", "S", o->end, "duration, s; default 10");
  add_contacts(c, o->in);
  add_start(c, o->start)
      .text("--pd", "TABLE", o->pd,
            "PD control to targets over time: columns t, q_0, ..., v_0, ...; linear between rows, forces within limits")
      .number("--kp", "GAIN", o->kp,
              "for --pd, Nm/rad or N/m; default 100/s^2 times the largest effective mass at targets")
      .number("--kd", "GAIN", o->kd, "for --pd, Nms/rad or Ns/m; default 20/s times that mass")
      .flag("--compensate", o->compensate, "adds gravity compensation to --pd")
      .text(
          "--input", "TABLE", o->input,
          "inputs over time: columns t, names of inputs, and tau_0, ... for forces on coordinates; linear between rows")
      .flag("--motors", o->motors, "adds the motors of the robot file, with their inputs");
  add_solver(c, o->solver)
      .text("--record", "FILE", o->record,
            "records coordinates, inputs and energies: .csv, .npy, .mcap (Foxglove, PlotJuggler), .ssv, .tsv")
      .texts("--column", "NAME", o->columns,
             "also records this column, such as tool/position or tool/velocity/x; repeatable")
      .flag("--frames", o->frames, "also records the poses of all frames")
      .number("--every", "S", o->every, "time between rows of the recording, s; default 0.01")
      .flag("--event-rows", o->event_rows, "also records rows before and after each event, both at its time")
      .flag("--events", o->events, "lists the events: time, element, and for contacts what has changed")
      .flag("--json", o->json, "prints the result as JSON")
      .runs([o] { return simulate(*o); });
}

}  // namespace kte_tool
