#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/io/model_inputs.hpp>
#include <kte/io/recording.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "arrays.hpp"
#include "batch.hpp"
#include "chain.hpp"
#include "native_run.hpp"
#include "recorded_numbers.hpp"
#include "sweep_columns.hpp"

namespace kte_python {

namespace {

using kte::runtime_chain;

column_names with_prefix(const char* prefix, const column_names& all) {
  column_names out;
  for (const auto& name : all) out.push_back(prefix + name);
  return out;
}
void append(std::vector<double>& out, const Eigen::VectorXd& x) {
  out.insert(out.end(), x.data(), x.data() + x.size());
}

/// An operation: the columns of its third argument, what its results are called, the call, and that of many states.
struct operation {
  const char* name;
  const char* third;
  column_names (*results)(const column_names& of_v);
  void (*call)(const runtime_chain&, kte::runtime_state&, const case_numbers&, std::vector<double>&);
  void (*in_packs)(const runtime_chain&, std::size_t states, const std::vector<const double*>& in, double* out,
                   const interruptible_threads& team) = nullptr;
};
column_names force_names(const column_names& v) { return with_prefix("tau/", v); }
const operation operations[]{
    {"inverse_dynamics", "a", force_names,
     [](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x, std::vector<double>& out) {
       append(out, kte::inverse_dynamics(c, s, x.q, x.v, x.third));
     },
     inverse_dynamics_in_packs},
    {"forward_dynamics", "tau", [](const column_names& v) { return with_prefix("a/", v); },
     [](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x, std::vector<double>& out) {
       append(out, kte::forward_dynamics(c, s, x.q, x.v, x.third));
     },
     forward_dynamics_in_packs},
    {"mass_matrix", "",
     [](const column_names& v) {
       column_names all;
       for (const auto& i : v)
         for (const auto& j : v) all.push_back("M/" + i + "/" + j);
       return all;
     },
     [](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x, std::vector<double>& out) {
       const Eigen::MatrixXd m = kte::mass_matrix(c, s, x.q);
       append(out, m.reshaped());
     },
     mass_matrix_in_packs},
    {"gravity_forces", "", force_names,
     [](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x, std::vector<double>& out) {
       append(out, kte::gravity_forces(c, s, x.q));
     }},
    {"static_forces", "", force_names,
     [](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x, std::vector<double>& out) {
       append(out, kte::static_forces(c, s, x.q));
     }},
    {"nonlinear_effects", "", force_names,
     [](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x, std::vector<double>& out) {
       append(out, kte::nonlinear_effects(c, s, x.q, x.v));
     }},
    {"energy", "",
     [](const column_names&) {
       return column_names{"kinetic", "potential"};
     },
     [](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x, std::vector<double>& out) {
       const auto e = kte::energy(c, s, x.q, x.v);
       out.insert(out.end(), {e.kinetic, e.potential});
     }},
    {"centre_of_mass", "",
     [](const column_names&) {
       return column_names{"mass", "position/x", "position/y", "position/z"};
     },
     [](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x, std::vector<double>& out) {
       const auto m = kte::centre_of_mass(c, s, x.q);
       out.insert(out.end(), {m.mass, m.position.x, m.position.y, m.position.z});
     }},
};

const operation& operation_of(const std::string& name) {
  std::string known;
  for (const auto& o : operations) {
    if (name == o.name) return o;
    known.append(known.empty() ? "" : ", ").append(o.name);
  }
  throw kte::bad_argument("kte: a sweep has no operation '" + name + "', but " + known +
                          " and passes; others are called by a function");
}

/// What operations have in common: chains and states of cases.
class operation_run : public native_run {
 public:
  operation_run(const runtime_chain& c, const case_numbers& x, const column_names& columns, const std::string& third)
      : chain_(c), numbers_(x), columns_(c, columns, third), state_(c.make_state()) {}

 protected:
  /// f(chain, state with the inputs, numbers) for a case.
  template <class F>
  void with_case(const std::vector<double>& values, const F& f) {
    case_numbers x = numbers_;
    columns_.put(values, x);
    if (const auto varied = columns_.chain_with(values)) {
      auto s = varied->make_state();
      put(*varied, x.u, s), f(*varied, s, x);
    } else {
      put(chain_, x.u, state_), f(chain_, state_, x);
    }
  }
  /// Whether all cases are states of one chain without inputs, which can be computed in packs.
  bool are_states() const { return columns_.paths().empty() && numbers_.u.size() == 0 && can_be_in_packs(chain_); }
  /// The results of many cases, `count` numbers each; NaN for a case without a result.
  std::vector<double> together(const operation& o, const kte::sweep_cases& cases, std::uint64_t begin,
                               std::uint64_t end, std::size_t count) const {
    std::vector<double> q, v, third, values(cases.names().size());
    for (std::uint64_t i = begin; i < end; ++i) {
      for (std::size_t j = 0; j < values.size(); ++j) values[j] = cases(i, j);
      case_numbers x = numbers_;
      columns_.put(values, x);
      append(q, x.q), append(v, x.v), append(third, x.third);
    }
    const auto states = static_cast<std::size_t>(end - begin);
    std::vector<double> out(states * count, std::numeric_limits<double>::quiet_NaN());
    try {
      o.in_packs(chain_, states, {q.data(), v.data(), third.data()}, out.data(), interruptible_threads(1));
    } catch (const kte::error&) {  // of the first case without a result; the others are written
    }
    return out;
  }

 private:
  static void put(const runtime_chain& c, const Eigen::VectorXd& u, kte::runtime_state& s) {
    kte::detail::for_each_input(c, [&](std::string_view name, int at, int n) {
      if (n == 1)
        s.input(name) = u[at];
      else
        s.vector(name) = {u[at], u[at + 1], u[at + 2]};
    });
  }
  runtime_chain chain_;
  case_numbers numbers_;
  sweep_columns columns_;
  kte::runtime_state state_;
};

class named_operation final : public operation_run {
 public:
  named_operation(const operation& o, const runtime_chain& c, const case_numbers& x, const column_names& columns,
                  const column_names& keep)
      : operation_run(c, x, columns, o.third), operation_(o), in_packs_(o.in_packs != nullptr && are_states()) {
    const column_names all = o.results(names_of_numbers(c, false));
    count_ = all.size();
    kept_ = keep.empty() ? all : keep;
    for (const auto& name : kept_) {
      const auto at = std::find(all.begin(), all.end(), name);
      if (at == all.end()) {
        std::string known;
        for (const auto& each : all) known.append(known.empty() ? "'" : ", '").append(each).append("'");
        throw kte::unknown_name("kte: " + std::string(o.name) + " has no result '" + name + "', but " + known);
      }
      places_.push_back(static_cast<std::size_t>(at - all.begin()));
    }
  }
  std::unique_ptr<native_run> clone() const override { return std::make_unique<named_operation>(*this); }
  const column_names& kept() const override { return kept_; }
  void operator()(const std::vector<double>& values, std::vector<double>& kept) override {
    with_case(values, [&](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x) {
      results_.clear();
      operation_.call(c, s, x, results_);
      for (const auto i : places_) kept.push_back(results_[i]);
    });
  }
  std::vector<std::vector<double>> in_packs(const kte::sweep_cases& cases, std::uint64_t begin,
                                            std::uint64_t end) override {
    auto all = native_run::in_packs(cases, begin, end);
    if (!in_packs_) return all;
    const auto out = together(operation_, cases, begin, end, count_);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double* const results = out.data() + i * count_;
      if (std::any_of(results, results + count_, [](double x) { return std::isnan(x); })) continue;
      for (const auto k : places_) all[i].push_back(results[k]);
    }
    return all;
  }

 private:
  operation operation_;
  bool in_packs_;
  std::size_t count_ = 0;  ///< of results
  column_names kept_;
  std::vector<std::size_t> places_;
  std::vector<double> results_;
};

/// The passes doMotion and doForce at q, v and a, and quantities of the state.
class passes_run final : public operation_run {
 public:
  passes_run(const runtime_chain& c, const case_numbers& x, const column_names& columns, const column_names& keep)
      : operation_run(c, x, columns, "a"), what_(kept_quantities(c, keep)) {
    kept_.assign(what_.columns.begin() + 1, what_.columns.end());
  }
  std::unique_ptr<native_run> clone() const override { return std::make_unique<passes_run>(*this); }
  const column_names& kept() const override { return kept_; }
  void operator()(const std::vector<double>& values, std::vector<double>& kept) override {
    with_case(values, [&](const runtime_chain& c, kte::runtime_state& s, const case_numbers& x) {
      kte::set_positions(s, x.q), kte::set_velocities(s, x.v), kte::set_accelerations(s, x.third);
      c.doMotion(s), c.clearForce(s), c.doForce(s);
      kept.resize(kept_.size());
      read_numbers(what_.cells, c, s, kept.data());
    });
  }

 private:
  kte::detail::recording what_;
  column_names kept_;
};

}  // namespace

std::unique_ptr<native_run> make_operation_run(py::handle run, const column_names& columns, const column_names& keep) {
  const py::object object = run.attr("chain");
  const auto& c = chain_of(object).chain();
  const auto vector = [&](const char* name) {
    const py::object x = run.attr(name);
    return x.is_none() ? Eigen::VectorXd(Eigen::VectorXd::Zero(c.dofs())) : vector_from(name, x, c.dofs());
  };
  const auto name = run.attr("operation").cast<std::string>();
  const bool passes = name == "passes";
  const std::string third = passes ? "a" : operation_of(name).third;
  for (const char* other : {"a", "tau"})
    if (third != other && !run.attr(other).is_none())
      throw kte::bad_argument("kte: " + name + " has no argument '" + other + "'");
  const case_numbers x{vector_from("q", run.attr("q"), c.nq()), vector("v"),
                       third.empty() ? Eigen::VectorXd() : vector(third.c_str()), inputs_from(c, run.attr("inputs"))};
  if (passes) return std::make_unique<passes_run>(c, x, columns, keep);
  return std::make_unique<named_operation>(operation_of(name), c, x, columns, keep);
}

}  // namespace kte_python
