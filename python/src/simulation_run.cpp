#include <kte/io/model_inputs.hpp>
#include <kte/io/recording.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "arrays.hpp"
#include "chain.hpp"
#include "coordinate_forces.hpp"
#include "native_run.hpp"
#include "recorded_numbers.hpp"
#include "simulation_in_lanes.hpp"
#include "solvers.hpp"
#include "sweep_columns.hpp"

namespace kte_python {

namespace {

/// How rows of a quantity become a number: the mean is that over time, by the trapezoidal rule.
enum class reduction { last, least, most, mean };
/// Results of a simulation other than its state.
enum class outcome { end_time, events, steps };
constexpr std::array<std::pair<std::string_view, outcome>, 3> outcomes{
    {{"run/end_time", outcome::end_time}, {"run/events", outcome::events}, {"run/steps", outcome::steps}}};
constexpr std::array<std::pair<std::string_view, reduction>, 3> reductions{
    {{"min:", reduction::least}, {"max:", reduction::most}, {"mean:", reduction::mean}}};

/// The kept numbers of a simulation, and their names: quantities of the final state, `max:QUANTITY` ... of its rows,
/// and outcomes.
struct kept_of_simulation {
  struct number {
    bool is_outcome = false;
    outcome what{};
    reduction how = reduction::last;
    std::size_t column = 0;  ///< of `recorded`
  };
  std::vector<std::string> names;
  std::vector<number> numbers;
  std::vector<kte::detail::recorded> cells;
  std::size_t columns = 0;
  bool of_rows = false;  ///< whether rows before the last one are needed
  bool of_steps = false;

  kept_of_simulation(const kte::runtime_chain& c, const std::vector<std::string>& keep) {
    std::vector<std::string> all = keep;
    if (all.empty())
      for (const auto* end : {"", "/v"})
        for (const auto& e : kte::layout(c)) all.push_back(e.name + end);
    for (const auto& name : all) {
      const auto known = std::find_if(outcomes.begin(), outcomes.end(), [&](const auto& o) { return o.first == name; });
      if (known != outcomes.end()) {
        names.push_back(name), numbers.push_back({true, known->second});
        of_steps = of_steps || known->second == outcome::steps;
        continue;
      }
      std::string_view prefix;
      reduction how = reduction::last;
      for (const auto& [text, r] : reductions)
        if (name.starts_with(text)) prefix = text, how = r, of_rows = true;
      const auto what = kept_quantities(c, {name.substr(prefix.size())});
      for (std::size_t i = 1; i < what.columns.size(); ++i) {
        names.push_back(std::string(prefix) + what.columns[i]);
        numbers.push_back({false, {}, how, columns++});
      }
      cells.insert(cells.end(), what.cells.begin(), what.cells.end());
    }
  }
  /// Whether all of them are positions and velocities of coordinates, which depend on no parameter of the chain.
  bool are_of_state() const {
    return std::all_of(cells.begin(), cells.end(), [](const kte::detail::recorded& c) {
      return c.what == kte::kind::gen && c.quantity < 2 && !c.is_energy();
    });
  }
};

struct simulation_settings {
  kte::runtime_chain chain;
  bool has_forces;
  double begin, time, every;
  solver_options solver;
  case_numbers start;
};

class simulation_run final : public native_run {
 public:
  simulation_run(simulation_settings s, const std::vector<std::string>& columns, const std::vector<std::string>& keep,
                 stop_flag stop)
      : s_(std::move(s)),
        columns_(s_.chain, columns, s_.has_forces ? "tau" : ""),
        kept_(s_.chain, keep),
        stop_(std::move(stop)) {
    kte::detail::for_each_input(s_.chain, [this](std::string_view name, int u, int n) {
      inputs_.push_back({std::string(name), u, n});
    });
    in_lanes_ = !kept_.of_rows && !kept_.of_steps && s_.time > 0 && can_be_in_lanes(s_.chain, s_.solver.name);
  }
  std::unique_ptr<native_run> clone() const override { return std::make_unique<simulation_run>(*this); }
  const std::vector<std::string>& kept() const override { return kept_.names; }

  void operator()(const std::vector<double>& values, std::vector<double>& kept) override {
    case_numbers x = s_.start;
    columns_.put(values, x);
    auto chain = columns_.chain_with(values).value_or(s_.chain);
    case_plant of_case(*this, chain, x);
    plant& p = of_case.p;

    const double end = s_.begin + s_.time;
    const auto solver = start_solver(p, x.q, x.v, s_.begin, s_.solver);
    const auto times = kept_.of_rows ? even_times(s_.begin, end, s_.every) : std::vector<double>{end};
    rows_ = 0, row_.resize(kept_.columns), before_.resize(kept_.columns), reduced_.resize(kept_.numbers.size());
    const auto ended = solver->advance(end, {}, {false, times}, [&](double t, const plant::state& state) {
      if (kept_.of_rows) add_row(p, *solver, t, state);
    });
    kte::detail::require_no_zeno(ended.reason, solver->time(), ended.stopped_by_name);
    read_numbers(kept_.cells, p.model().chain(), state_at(p, *solver, solver->time(), solver->state()), row_.data());
    const double duration = solver->time() - s_.begin;
    for (std::size_t i = 0; i < kept_.numbers.size(); ++i) {
      const auto& n = kept_.numbers[i];
      kept.push_back(n.is_outcome               ? outcome_of(n.what, *solver, ended)
                     : n.how == reduction::last ? row_[n.column]
                     : n.how == reduction::mean ? (duration == 0 ? row_[n.column] : reduced_[i] / duration)
                                                : reduced_[i]);
    }
  }

  std::vector<std::vector<double>> in_packs(const kte::sweep_cases& cases, std::uint64_t begin,
                                            std::uint64_t end) override {
    if (!in_lanes_) return native_run::in_packs(cases, begin, end);
    const auto values_of = [&cases](std::uint64_t i) {
      std::vector<double> values(cases.names().size());
      for (std::size_t j = 0; j < values.size(); ++j) values[j] = cases(i, j);
      return values;
    };
    const simulation_in_lanes lanes{s_.chain,
                                    columns_.paths(),
                                    s_.solver.name,
                                    s_.begin,
                                    s_.begin + s_.time,
                                    s_.solver.step,
                                    s_.solver.tolerances,
                                    [&](std::uint64_t i) {
                                      const auto values = values_of(i);
                                      case_numbers x = s_.start;
                                      columns_.put(values, x);
                                      return lane_numbers{columns_.parameters(values), x.q, x.v, x.third, x.u};
                                    },
                                    *stop_};
    auto all = final_states(lanes, cases, begin, end);
    std::optional<case_plant> of_chain;
    for (std::uint64_t i = begin; i < end; ++i) {
      auto& numbers = all[static_cast<std::size_t>(i - begin)];
      if (numbers.empty()) continue;
      const auto values = values_of(i);
      case_numbers x = s_.start;
      columns_.put(values, x);
      if (!kept_.are_of_state() || !of_chain) {
        auto chain = kept_.are_of_state() ? s_.chain : columns_.chain_with(values).value_or(s_.chain);
        of_chain.emplace(*this, chain, x);
      }
      try {
        numbers = at_end(of_chain->p, Eigen::VectorXd::Map(numbers.data(), s_.chain.nq() + s_.chain.dofs()));
      } catch (const kte::error&) {
        numbers.clear();  // the case alone gives the reason
      }
    }
    return all;
  }

 private:
  struct input {
    std::string name;
    int u, count;
  };
  /// A chain under the forces and inputs of a case.
  struct case_plant {
    const simulation_run& run;
    const case_numbers x;
    coordinate_forces forces;
    Eigen::VectorXd constant;
    plant p;

    /// Adds the forces to the chain.
    case_plant(const simulation_run& r, kte::runtime_chain& chain, case_numbers numbers)
        : run(r),
          x(std::move(numbers)),
          forces(r.s_.has_forces ? coordinate_forces(chain) : coordinate_forces()),
          p(
              chain,
              [this](double, const plant::state& state, Eigen::VectorXd& u) {
                if (*run.stop_) throw stopped{};
                u = constant;
                if (run.s_.has_forces) forces.put(x.third, state, u);
              },
              forces.of_tau_alone()) {
      constant = run.inputs_of(p.model(), x.u);
    }
    case_plant(const case_plant&) = delete;
    case_plant& operator=(const case_plant&) = delete;
  };
  /// The kept numbers of a final state (q, v) of lanes.
  std::vector<double> at_end(plant& p, const Eigen::VectorXd& state) {
    const double end = s_.begin + s_.time;
    const Eigen::Index nq = s_.chain.nq();
    row_.resize(kept_.columns);
    const auto x = p.model().make_x(Eigen::VectorXd(state.head(nq)), Eigen::VectorXd(state.tail(state.size() - nq)));
    read_numbers(kept_.cells, p.model().chain(), p.state_at(end, x), row_.data());
    std::vector<double> kept;
    for (const auto& n : kept_.numbers)
      kept.push_back(!n.is_outcome ? row_[n.column] : n.what == outcome::end_time ? end : 0.0);  // without events
    return kept;
  }
  /// The inputs of a model whose chain may have more of them than the columns know.
  Eigen::VectorXd inputs_of(const plant::model_type& m, const Eigen::VectorXd& given) const {
    Eigen::VectorXd u = m.input();
    kte::detail::for_each_input(m, [&](std::string_view name, int at, int n) {
      for (const auto& i : inputs_)
        if (i.name == name) u.segment(at, n) = given.segment(i.u, n);
    });
    return u;
  }
  /// The state of the chain, with the contact forces of the step if the solver has such.
  static const kte::runtime_state& state_at(plant& p, any_solver& solver, double t, const plant::state& x) {
    const auto* const of_step = solver.state_at(t, x);
    return of_step != nullptr ? *of_step : p.state_at(t, x);
  }
  /// Integrals of means: the sum of (t - t_before) (row + row_before) / 2. Rows before and after an event have one
  /// time.
  void add_row(plant& p, any_solver& solver, double t, const plant::state& state) {
    read_numbers(kept_.cells, p.model().chain(), state_at(p, solver, t, state), row_.data());
    for (std::size_t i = 0; i < kept_.numbers.size(); ++i) {
      const auto& n = kept_.numbers[i];
      if (n.is_outcome) continue;
      const double now = row_[n.column];
      double& r = reduced_[i];
      if (n.how == reduction::mean)
        r = rows_ == 0 ? 0 : r + (t - last_) / 2 * (now + before_[n.column]);
      else
        r = rows_ == 0 ? now : n.how == reduction::least ? std::min(r, now) : std::max(r, now);
    }
    ++rows_, last_ = t, before_ = row_;
  }
  static double outcome_of(outcome what, const any_solver& solver, const report& ended) {
    return what == outcome::end_time ? solver.time()
           : what == outcome::events ? static_cast<double>(ended.count)
                                     : static_cast<double>(solver.statistics().steps);
  }

  simulation_settings s_;
  sweep_columns columns_;
  kept_of_simulation kept_;
  stop_flag stop_;
  bool in_lanes_ = false;
  std::vector<input> inputs_;
  std::size_t rows_ = 0;
  double last_ = 0;  ///< the time of the last row
  std::vector<double> row_, before_, reduced_;
};

}  // namespace

std::unique_ptr<native_run> make_simulation_run(py::handle run, const std::vector<std::string>& columns,
                                                const std::vector<std::string>& keep, stop_flag stop) {
  const py::object chain = run.attr("chain"), control = run.attr("control"), v = run.attr("v");
  const auto& c = chain_of(chain).chain();
  const auto n = c.dofs();
  const auto number = [&run](const char* name) { return run.attr(name).cast<double>(); };
  const auto tolerance = [&](const char* name) {
    return run.attr(name).is_none() ? number("tolerance") : number(name);
  };
  const auto zero = Eigen::VectorXd(Eigen::VectorXd::Zero(n));
  simulation_settings s{
      c,
      !control.is_none(),
      number("t"),
      number("time"),
      number("every"),
      {run.attr("solver").cast<std::string>(),
       number("step"),
       {.absolute = tolerance("absolute"),
        .relative = tolerance("relative"),
        .max_steps = run.attr("max_steps").cast<long long>()}},
      {vector_from("q", run.attr("q"), c.nq()), v.is_none() ? zero : vector_from("v", v, n),
       control.is_none() ? zero : vector_from("control", control, n), inputs_from(c, run.attr("inputs"))}};
  check_solver(s.solver.name);
  s.solver.tolerances.largest_step = number("largest_step");
  return std::make_unique<simulation_run>(std::move(s), columns, keep, std::move(stop));
}

}  // namespace kte_python
