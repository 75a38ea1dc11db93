#include "simulation.hpp"

#include <kte/dynamics/state_vectors.hpp>
#include <kte/io/model_inputs.hpp>

#include <cmath>
#include <pybind11/stl.h>
#include <utility>

#include "call.hpp"
#include "parts.hpp"

namespace kte_python {

py::dict statistics_of(const kte::step_statistics& s) {
  py::dict all;
  all["steps"] = s.steps, all["rejected"] = s.rejected, all["evaluations"] = s.evaluations;
  all["jacobians"] = s.jacobians, all["factorizations"] = s.factorizations;
  return all;
}

void check_solver(const std::string& name) {
  const std::string known = std::string(solvers_with_tolerances) + ", " + solvers_of_fixed_step + ",";
  if (name.empty() || (" " + known).find(" " + name + ",") == std::string::npos)
    throw kte::bad_argument("kte: there is no solver '" + name + "', but " + solvers_with_tolerances +
                            "; of a fixed step " + solvers_of_fixed_step);
}

std::unique_ptr<any_solver> start_solver(plant& p, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                         const solver_options& o) {
  check_solver(o.name);
  if (!(o.step > 0)) throw kte::bad_argument("kte: step must be positive, got " + kte::detail::number(o.step));
  plant::state x = p.make_x(t, q, v);
  p.set_inputs(t, x);
  x = kte::settled(p.model(), t, x);
  auto solver = make_explicit_solver(p, x, t, o);
  if (!solver) solver = make_stiff_solver(p, x, t, o);
  if (!solver) solver = make_fixed_step_solver(p, x, t, o);
  if (!solver) solver = make_contact_solver(p, x, t, o);
  return solver;
}

std::vector<double> even_times(double begin, double end, double spacing) {
  std::vector<double> times;
  if (!std::isfinite(end)) throw kte::bad_argument("kte: the end time must be finite, got " + kte::detail::number(end));
  const double span = std::abs(end - begin);
  if (!(spacing > 0)) throw kte::bad_argument("kte: every must be positive, got " + kte::detail::number(spacing));
  const double count = std::floor(span / spacing * (1 + 4e-16) + 1e-9);
  if (!(count < 1e9))
    throw kte::bad_argument("kte: a time of " + kte::detail::number(span) +
                            " s has more than a thousand million rows every " + kte::detail::number(spacing) + " s");
  times.push_back(begin);
  for (double i = 1; i <= count; ++i) times.push_back(begin + (end > begin ? i : -i) * spacing);
  if (times.size() > 1 && std::abs(times.back() - end) <= 1e-9 * spacing) times.pop_back();
  if (times.back() != end) times.push_back(end);
  return times;
}

simulation::simulation(py::object drawn, kte::runtime_chain c, py::object control, double control_every,
                       const py::dict& inputs, const py::list& events, const py::dict& gates, bool of_time_alone,
                       bool holds_control)
    : drawn_(std::move(drawn)),
      has_forces_(!control.is_none()),
      forces_(has_forces_ ? coordinate_forces(c) : coordinate_forces()),
      chain_(std::move(c)),
      plant_(
          with_gates(chain_, gates_of(gates)),
          [this](double t, const plant::state& x, Eigen::VectorXd& u) { law(t, x, u); },
          of_time_alone && forces_.of_tau_alone()),
      control_every_(control_every),
      holds_control_(holds_control) {
  u_ = plant_.model().input();
  tau_ = Eigen::VectorXd::Zero(chain_.dofs());
  set_control(std::move(control));
  set_inputs(inputs);
  for (const auto e : events) {
    const auto direction = e.attr("direction").cast<std::string>();
    if (direction != "rising" && direction != "falling" && direction != "both")
      throw kte::bad_argument("kte: direction of an event must be 'rising', 'falling' or 'both', got '" + direction +
                              "'");
    events_.push_back({py::reinterpret_borrow<py::object>(e), e.attr("function"), e.attr("reset"),
                       e.attr("name").cast<std::string>(),
                       direction == "rising"    ? kte::crossing::rising
                       : direction == "falling" ? kte::crossing::falling
                                                : kte::crossing::both,
                       e.attr("terminal").cast<bool>(), e.attr("one_sided").cast<bool>()});
  }
  for (std::size_t i = 0; i < events_.size(); ++i) {
    auto& e = events_[i];
    if (e.name.empty()) e.name = "event " + std::to_string(i);
    const kte::event_options options{
        .direction = e.direction, .is_terminal = e.terminal, .is_one_sided = e.one_sided, .name = e.name};
    constexpr kte::detail::no_handler none;
    if (e.reset.is_none())
      lists_.plain.emplace_back(event_value{this, i}, options, none, none);
    else
      lists_.acting.emplace_back(event_value{this, i}, options, event_reset{this, i}, none);
  }
}

void simulation::start(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, const solver_options& o) {
  begin_ = t;
  if (is_sampled()) tau_ = control_at(t, plant_.make_x(t, q, v)), samples_ = 1;  // modes settle by it
  solver_ = start_solver(plant_, q, v, t, o);
}

void simulation::set_control(py::object control) {
  if (control.is_none()) return;
  forget_calls();
  if (!has_forces_)
    throw kte::bad_argument("kte: a simulation that was made without control cannot have one later: give it zeros");
  if (py::hasattr(control, "__call__")) {
    control_ = std::move(control);
  } else {
    tau_ = vector_from("control", control, plant_.model().dofs());
    control_ = py::none();
  }
}

void simulation::set_inputs(const py::dict& inputs) {
  forget_calls();
  for (const auto& [key, value] : inputs) {
    const auto name = key.cast<std::string>();
    Eigen::Index place = -1;
    int count = 0;
    std::string known;
    kte::detail::for_each_input(plant_.model(), [&](std::string_view input, int u, int n) {
      if (input == name) place = u, count = n;
      known.append(known.empty() ? " (there are '" : ", '").append(input).append("'");
    });
    if (place < 0)
      throw kte::unknown_name("kte: this chain has no input '" + name + "'" + (known.empty() ? "" : known + ")"));
    std::erase_if(laws_, [&](const input_law& l) { return l.u == place; });
    if (py::hasattr(value, "__call__"))
      laws_.push_back({name, place, count, py::reinterpret_borrow<py::object>(value)});
    else
      u_.segment(place, count) = vector_from(name.c_str(), value, count);
  }
}

std::pair<py::object, py::object> simulation::q_and_v(const plant::state& x) const {
  const auto& m = plant_.model();
  return {to_array(Eigen::VectorXd(m.positions_of(x))), to_array(Eigen::VectorXd(m.velocities_of(x)))};
}

std::map<std::string, gate> simulation::gates_of(const py::dict& functions) {
  std::map<std::string, gate> all;
  for (const auto& [key, function] : functions) {
    const auto name = key.cast<std::string>();
    if (!py::hasattr(function, "__call__"))
      throw py::type_error("kte: only_if of '" + name + "' must be a function of (t, q, v), not " +
                           py::repr(function).cast<std::string>());
    gates_[name] = py::reinterpret_borrow<py::object>(function);
    all[name] = [this, name](double t, const kte::runtime_state& s) { return admits(name, t, s); };
  }
  return all;
}
/// Without the GIL.
bool simulation::admits(const std::string& contact, double t, const kte::runtime_state& s) const {
  const py::gil_scoped_acquire with;
  const py::object open = gates_.at(contact)(t, to_array(Eigen::VectorXd(kte::positions(s))),
                                             to_array(Eigen::VectorXd(kte::velocities(s))));
  if (open.is_none())
    throw py::type_error("kte: only_if of '" + contact + "' must return whether the contact lands, not None");
  const int is = PyObject_IsTrue(open.ptr());
  if (is < 0) throw py::error_already_set();
  return is == 1;
}

/// Without the GIL.
void simulation::law(double t, const plant::state& x, Eigen::VectorXd& u) {
  watch_();
  if (!laws_.empty() && !(inputs_at_ && inputs_at_->is_of(t, moving_part(x)))) {
    const py::gil_scoped_acquire with;
    const auto [q, v] = q_and_v(x);
    for (const auto& l : laws_) u_.segment(l.u, l.count) = vector_from(l.name.c_str(), l.function(t, q, v), l.count);
    inputs_at_ = sample{t, moving_part(x), {}};
  }
  u = u_;
  if (has_forces_) forces_.put(forces_at(t, x), x, u);
}
Eigen::VectorXd simulation::control_at(double t, const plant::state& x) const {
  const py::gil_scoped_acquire with;
  const auto [q, v] = q_and_v(x);
  return vector_from("the result of control", control_(t, q, v), tau_.size());
}
const Eigen::VectorXd& simulation::forces_at(double t, const plant::state& x) {
  if (control_.is_none() || is_sampled()) return tau_;
  const bool held = holds_control_ && solver_;
  const double when = held ? solver_->time() : t;
  const plant::state& where = held ? solver_->state() : x;
  if (!now_ || !now_->is_of(when, moving_part(where)))
    last_ = std::exchange(now_, sample{when, moving_part(where), control_at(when, where)});
  return t < when && last_ ? last_->tau : now_->tau;
}
double simulation::value(std::size_t event, double t, const plant::state& x) {
  const py::gil_scoped_acquire with;
  const auto [q, v] = q_and_v(x);
  return vector_from(events_[event].name.c_str(), events_[event].function(t, q, v), 1)[0];
}
void simulation::reset(std::size_t event, double t, plant::state& x) {
  const py::gil_scoped_acquire with;
  const auto [q, v] = q_and_v(x);
  const py::object after = events_[event].reset(t, q, v);
  if (!py::isinstance<py::tuple>(after) || py::len(after) != 2)
    throw py::type_error("kte: the reset of '" + events_[event].name + "' must return (q, v)");
  const auto& m = plant_.model();
  plant::state reset = x;
  reset.head(m.nq()) = vector_from("q of a reset", after[py::int_(0)], m.nq());
  reset.segment(m.nq(), m.dofs()) = vector_from("v of a reset", after[py::int_(1)], m.dofs());
  plant_.set_inputs(t, reset);
  try {
    x = kte::settled(m, t, reset);
  } catch (const kte::bad_argument& refused) {
    throw kte::bad_argument("kte: the state after the reset of '" + events_[event].name +
                            "' cannot be: " + std::string(refused.what()).substr(5));
  }
}

/// The times of samples, from now to the end.
std::vector<double> simulation::times_from(double end, py::handle every, py::handle at) const {
  if (at.is_none()) return even_times(solver_->time(), end, number_from("every", every));
  const auto all = vector_from("at", at, -1);
  return {all.data(), all.data() + all.size()};
}

double simulation::sample_control(double end) {
  const double rounding = 1e-9 * control_every_;
  if (next_sample() <= solver_->time() + rounding) {
    tau_ = control_at(solver_->time(), solver_->state());
    forget_calls();
    samples_ = static_cast<long long>(std::floor((solver_->time() + rounding - begin_) / control_every_)) + 1;
  }
  return next_sample() < end - rounding ? next_sample() : end;
}

py::object simulation::advance(double end, py::handle every, py::handle at) {
  if (running_) throw kte::bad_argument("kte: the simulation is running already, in another thread or in this call");
  forget_calls();  // what functions depend on may have changed
  if (end < solver_->time() && plant_.model().contacts() > 0)
    throw kte::bad_argument("kte: rigid contacts act forward in time only: the end time " + kte::detail::number(end) +
                            " is before " + kte::detail::number(solver_->time()));
  const bool sampled = is_sampled();
  if (sampled && end < solver_->time())
    throw kte::bad_argument("kte: control_every goes forward in time only: the end time " + kte::detail::number(end) +
                            " is before " + kte::detail::number(solver_->time()));
  sampling when{every.is_none() && at.is_none(), {}};
  std::vector<double> times;
  if (!when.every_step) times = times_from(end, every, at), when.times = times;

  auto made = std::make_unique<recording_object>();
  auto& r = *made;
  r.chain = chain_, r.drawn = drawn_;
  const auto x = solver_->state();
  r.nx = static_cast<std::size_t>(x.size()), r.nu = static_cast<std::size_t>(u_.size());
  recording_ = py::cast(std::move(made));

  struct in_use {
    bool& flag;
    explicit in_use(bool& f) : flag(f) { flag = true; }
    ~in_use() { flag = false; }
  } const used(running_);
  bool goes_on = false;  // the first row of a further part is the last one of the part before
  const auto observe = [this, &r, &when, &goes_on](double t, const plant::state& now) {
    if (std::exchange(goes_on, false) && when.every_step) return;
    plant_.set_inputs(t, now);
    const auto& u = plant_.model().input();
    when.every_step ? r.add_time(t) : r.add_time(t, when.times);
    r.x.insert(r.x.end(), now.data(), now.data() + r.nx);
    r.u.insert(r.u.end(), u.data(), u.data() + u.size());
    if (const auto* const s = solver_->state_at(t, now)) r.add(*s);
  };
  report ended;
  std::size_t given = 0;
  do {
    const double to = sampled ? sample_control(end) : end;
    sampling part = when;
    if (sampled && to < end) {
      const auto first = times.begin() + static_cast<std::ptrdiff_t>(given);
      const auto last = std::find_if(first, times.end(), [to](double t) { return t > to; });
      part.times = std::span(first, last);
    } else {
      part.times = part.times.subspan(given);
    }
    given += part.times.size();
    {
      const py::gil_scoped_release without;
      ended = solver_->advance(to, lists_, part, observe);
    }
    for (const auto& e : ended.events) r.events.push_back({e.name, e.time, e.before, e.after, e.what});
    goes_on = true;
  } while (sampled && ended.reason == kte::stop_reason::end_time && solver_->time() < end);
  const bool is_terminal = ended.reason == kte::stop_reason::terminal;
  if (is_terminal && at.is_none()) r.asked.back() = 1;  // even times have the end
  r.reason = is_terminal ? "terminal" : "end_time";
  r.stopped_by = ended.stopped_by_name;
  r.statistics = solver_->statistics();
  kte::detail::require_no_zeno(ended.reason, solver_->time(), ended.stopped_by_name);
  return recording_;
}

namespace {

[[noreturn]] void refuse_event(py::handle e) {
  throw py::type_error("kte: events must be an Event or a list of them, not " + py::repr(e).cast<std::string>());
}

std::unique_ptr<simulation> make_simulation(py::object chain, py::handle q, py::handle v, double t,
                                            const std::string& solver, double tolerance, py::handle absolute,
                                            py::handle relative, double step, long long max_steps, double largest_step,
                                            py::object control, py::handle control_every, py::handle inputs,
                                            py::handle events, py::handle only_if, bool implicit_control) {
  const auto& c = chain_of(chain).chain();
  const auto dict_or_none = [](const char* what, const char* of, py::handle x) {
    return x.is_none() ? py::dict() : dict_from(what, of, x);
  };
  const auto signals = dict_or_none("inputs", "signals to numbers or functions of (t, q, v)", inputs);
  const bool is_function = py::hasattr(control, "__call__");
  const double period = control_every.is_none() ? 0 : number_from("control_every", control_every);
  if (!control_every.is_none() && !is_function)
    throw kte::bad_argument("kte: control_every needs a control that is a function of (t, q, v)");
  if (!control_every.is_none() && !(period > 0 && std::isfinite(period)))
    throw kte::bad_argument("kte: control_every must be positive and finite, got " + kte::detail::number(period));
  bool of_time_alone = !is_function || period > 0;
  for (const auto& [name, value] : signals) of_time_alone = of_time_alone && !py::hasattr(value, "__call__");
  py::list list;
  if (!events.is_none()) {
    if (py::hasattr(events, "function"))
      list.append(events);
    else if (py::hasattr(events, "__iter__"))
      for (const auto e : events) list.append(e);
    else
      refuse_event(events);
    for (const auto e : list)
      if (!py::hasattr(e, "function")) refuse_event(e);
  }
  const bool steps_contacts = solver == "moreau_jean";
  if (implicit_control && !steps_contacts)
    throw kte::bad_argument("kte: implicit_control is an option of moreau_jean, not of " + solver);
  const bool holds_control = steps_contacts && !implicit_control;
  const auto gates = dict_or_none("only_if", "contacts to functions of (t, q, v)", only_if);
  auto made = std::make_unique<simulation>(chain, c, std::move(control), period, signals, list, gates,
                                           of_time_alone || holds_control, holds_control);
  solver_options o{solver, step, {.absolute = tolerance, .relative = tolerance, .max_steps = max_steps}};
  if (!absolute.is_none()) o.tolerances.absolute = number_from("absolute", absolute);
  if (!relative.is_none()) o.tolerances.relative = number_from("relative", relative);
  o.tolerances.largest_step = largest_step;
  made->start(vector_from("q", q, c.nq()),
              v.is_none() ? Eigen::VectorXd(Eigen::VectorXd::Zero(c.dofs())) : vector_from("v", v, c.dofs()), t, o);
  return made;
}

}  // namespace

void bind_simulation(py::module_& m) {
  using namespace py::literals;
  const auto none = py::none();
  py::class_<simulation>(m, "Simulation", R"(Simulation(chain, q, v=None, *, t=0, solver="dormand_prince45",
           tolerance=1e-9, absolute=None, relative=None, step=1e-3, max_steps=1000000000, largest_step=0,
           control=None, control_every=None, inputs=None, events=None, only_if=None, implicit_control=False)

A mechanism that moves, from q and v at the time t.

solver     dormand_prince45, prince_dormand87, adams, bdf, rodas, rosenbrock23,
           kennedy_carpenter34, tr_bdf2, trapezoidal, with `tolerance` (or `absolute` and `relative`) a step;
           runge_kutta4, runge_kutta5, euler, midpoint, semi_implicit_euler, implicit_midpoint, and moreau_jean for rigid
           contacts, with `step`, s
control    forces on all numbers of v, N and Nm: a function of (t, q, v), or an array that is constant until it is set.
           Functions are called at the stages of steps, again after rejected steps, and where events are located, so
           their times are not in order; `moreau_jean` calls control once a step, at its begin, and holds its forces
control_every
           the time between calls of a control that is a function, s: a controller with a sample time, which may have a
           memory. It is called at these times in order, once each, and its forces stay until the next call; a row at
           such a time has those up to it
inputs     a dict from signals to numbers, or to functions of (t, q, v), called as control; `moreau_jean` calls them
           several times a step
events     an `Event` or a list of them
only_if    a dict from rigid contacts to functions of (t, q, v): the contact lands only where they are true, and passes
           through its surface elsewhere
implicit_control
           of `moreau_jean`: functions of control and inputs may be stiff. Each step calls them at its middle, and once
           more for each q and v, for derivatives by differences)")
      .def(py::init(&make_simulation), "chain"_a, "q"_a, "v"_a = none, py::kw_only(), "t"_a = 0.0,
           "solver"_a = "dormand_prince45", "tolerance"_a = 1e-9, "absolute"_a = none, "relative"_a = none,
           "step"_a = 1e-3, "max_steps"_a = 1'000'000'000LL, "largest_step"_a = 0.0, "control"_a = none,
           "control_every"_a = none, "inputs"_a = none, "events"_a = none, "only_if"_a = none,
           "implicit_control"_a = false)
      .def(
          "__reduce__",
          [](const simulation&) -> py::object {
            throw py::type_error(
                "kte: a Simulation, which is between steps of its solver, can be neither copied nor pickled; a process "
                "makes its own from q and v");
          })
      .def("advance", &simulation::advance, R"(advance(end, *, every=None, at=None)

Integrates to the time `end`, s, and returns a `Recording` of every step, with the states before and after events, of even
times, or of the times `at`. Ctrl-C stops it, and so do exceptions of functions of yours; the rows until then are in
`recording`, and a further `advance` goes on.)",
           "end"_a, py::kw_only(), "every"_a = none, "at"_a = none)
      .def_property_readonly("t", &simulation::time, "The time, s.")
      .def_property_readonly(
          "q", [](const simulation& s) { return s.q_and_v(s.state()).first; }, "The configuration.")
      .def_property_readonly(
          "v", [](const simulation& s) { return s.q_and_v(s.state()).second; }, "The velocities.")
      .def("set_control", &simulation::set_control,
           "set_control(control)\n\nForces from now on: a function of (t, q, v), or an array.", "control"_a)
      .def("set_inputs", &simulation::set_inputs,
           "set_inputs(inputs)\n\nInputs from now on: a dict from signals to numbers, or to functions of (t, q, v).",
           "inputs"_a)
      .def_property_readonly("recording", &simulation::recording,
                             "The recording of the last `advance`, also of one that ended by an exception.")
      .def_property_readonly(
          "statistics", [](const simulation& s) { return statistics_of(s.statistics()); },
          "Counts of steps, rejected steps, evaluations, Jacobians and factorizations: a dict.")
      .def("__repr__", [](const simulation& s) {
        return "<kte.Simulation at t = " + py::repr(py::float_(s.time())).cast<std::string>() + " s>";
      });
}

}  // namespace kte_python
