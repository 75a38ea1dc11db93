#include "simulation_in_lanes.hpp"

#include <kte/dynamics/batch.hpp>
#include <kte/dynamics/lanes.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/io/model_inputs.hpp>
#include <kte/sweep/detail/lane_queue.hpp>
#include <kte/sweep/final_state.hpp>

#include <stdexcept>

#include "batch.hpp"
#include "sweep_columns.hpp"

namespace kte_python {

namespace {

using P = kte::batch::detail::pack_of<double, 0, 1>;
constexpr std::size_t width = P::lanes;
using packs = kte::runtime_vector<P>;

/// x' = (v, a) of x = (q, v), under forces and inputs that are constant.
class rates_in_lanes {
 public:
  rates_in_lanes(kte::runtime_chain c, packs tau, const packs& u, const std::atomic<bool>& stop)
      : chain_(std::move(c)), state_(chain_.make_state<P>()), tau_(std::move(tau)), stop_(&stop) {
    kte::detail::for_each_input(chain_, [&](std::string_view name, int at, int n) {
      if (n == 1)
        state_.input(name) = u[at];
      else
        state_.vector(name) = {u[at], u[at + 1], u[at + 2]};
    });
  }
  /// Sets other forces.
  void push(const packs& tau) { tau_ = tau; }
  packs operator()(const P&, const packs& x) {
    if (*stop_) throw std::runtime_error("stopped");
    const Eigen::Index n = tau_.size();
    q_ = x.head(n), v_ = x.tail(n);
    packs rate(2 * n);
    rate.head(n) = v_;
    rate.tail(n) = kte::forward_dynamics(chain_, state_, q_, v_, tau_);
    return rate;
  }

 private:
  kte::runtime_chain chain_;
  kte::basic_runtime_state<P> state_;
  packs tau_, q_, v_;
  const std::atomic<bool>* stop_;
};

/// What `kte::detail::lane_queue` asks of a simulation. `How`: tolerances or a step.
template <template <class, class> class Method, class How>
class lanes_of {
 public:
  static constexpr bool has_events = false;

  lanes_of(const simulation_in_lanes& s, How how) : s_(s), how_(std::move(how)) {}

  auto start(const kte::sweep_case<P>& c) const {
    std::array<lane_numbers, width> lane;
    for (std::size_t i = 0; i < width; ++i) lane[i] = s_.numbers_of_case(c.index(i));
    const auto packs_of = [&lane](auto member) {
      packs x(static_cast<Eigen::Index>((lane[0].*member).size()));
      for (Eigen::Index k = 0; k < x.size(); ++k)
        for (std::size_t i = 0; i < width; ++i) x[k].set(i, (lane[i].*member)[k]);
      return x;
    };
    std::vector<kte::parameter<P>> parameters;
    for (std::size_t j = 0; j < s_.paths.size(); ++j) {
      P value(0.0);
      for (std::size_t i = 0; i < width; ++i) value.set(i, lane[i].parameters[j]);
      parameters.push_back({s_.paths[j], value});
    }
    auto chain = parameters.empty() ? s_.chain : kte::lanes(s_.chain, std::span<const kte::parameter<P>>(parameters));
    const packs q = packs_of(&lane_numbers::q), v = packs_of(&lane_numbers::v);
    packs x(q.size() + v.size());
    x << q, v;
    return Method<rates_in_lanes, packs>(
        rates_in_lanes(std::move(chain), packs_of(&lane_numbers::tau), packs_of(&lane_numbers::u), s_.stop), s_.begin,
        x, how_);
  }
  double end_time(const kte::sweep_case<double>&) const { return s_.end; }
  template <class End>
  const auto& kept(const End& end) const {
    return end.state;
  }

 private:
  const simulation_in_lanes& s_;
  How how_;
};

template <template <class, class> class Method, class How>
std::vector<std::vector<double>> states_by(const simulation_in_lanes& s, How how, const kte::sweep_cases& cases,
                                           std::uint64_t first, std::uint64_t last) {
  const lanes_of<Method, How> simulation(s, std::move(how));
  const auto columns = static_cast<std::size_t>(s.chain.nq() + s.chain.dofs());
  std::vector<std::vector<double>> states;
  for (auto& r : kte::detail::lane_queue<P, lanes_of<Method, How>>(simulation, cases, columns)(first, last))
    states.push_back(r.failure.empty() ? std::move(r.kept) : std::vector<double>());
  return states;
}

}  // namespace

bool can_be_in_lanes(const kte::runtime_chain& c, const std::string& solver) {
  if (solver != "dormand_prince45" && solver != "runge_kutta4") return false;
  const auto& w = c.wiring();
  for (const auto k : {kte::kind::internal, kte::kind::loop, kte::kind::contact, kte::kind::rotation_3D,
                       kte::kind::pose_2D, kte::kind::pose_3D})
    if (w.count(k) > 0) return false;
  for (const auto& s : w.signals)
    if (s.u < 0) return false;  // the time
  bool switches = false;
  c.for_each_element([&switches](const kte::kte_element& e) { switches = switches || e.switches(); });
  return !switches && can_be_in_packs(c);
}

std::vector<std::vector<double>> final_states(const simulation_in_lanes& s, const kte::sweep_cases& cases,
                                              std::uint64_t first, std::uint64_t last) {
  return s.solver == "runge_kutta4" ? states_by<kte::runge_kutta4>(s, s.step, cases, first, last)
                                    : states_by<kte::dormand_prince45>(s, s.tolerances, cases, first, last);
}

void rollouts_in_lanes(const kte::runtime_chain& c, const rollout_arrays& x, double every, double step,
                       const interruptible_threads& team) {
  const auto nq = static_cast<std::size_t>(c.nq()), nv = static_cast<std::size_t>(c.dofs());
  const std::atomic<bool> never{false};
  team((x.count + width - 1) / width, [&](std::size_t task) {
    const auto number = [&](std::size_t lane) { return std::min(task * width + lane, x.count - 1); };
    const auto read = [&](const double* from, std::size_t stride, std::size_t n) {
      packs all(static_cast<Eigen::Index>(n));
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < width; ++i) all[static_cast<Eigen::Index>(k)].set(i, from[number(i) * stride + k]);
      return all;
    };
    packs state(static_cast<Eigen::Index>(nq + nv));
    state << read(x.q0, nq, nq), read(x.v0, nv, nv);
    const packs none = packs::Zero(static_cast<Eigen::Index>(names_of_inputs(c).size()));
    rates_in_lanes rates(c, packs::Zero(static_cast<Eigen::Index>(nv)), none, never);
    const auto write = [&](std::size_t row) {
      for (std::size_t i = 0; i < width && task * width + i < x.count; ++i) {
        const std::size_t at = number(i) * (x.steps + 1) + row;
        for (std::size_t k = 0; k < nq; ++k) x.q[at * nq + k] = state[static_cast<Eigen::Index>(k)][i];
        for (std::size_t k = 0; k < nv; ++k) x.v[at * nv + k] = state[static_cast<Eigen::Index>(nq + k)][i];
      }
    };
    kte::runge_kutta4<std::reference_wrapper<rates_in_lanes>, packs> solver(std::ref(rates), 0.0, state, step);
    write(0);
    for (std::size_t row = 0; row < x.steps; ++row) {
      rates.push(read(x.tau + row * nv, x.steps * nv, nv));
      solver.restart(0.0, state);  // the forces have changed
      solver.integrate(every);
      state = solver.state();
      write(row + 1);
    }
  });
}

}  // namespace kte_python
