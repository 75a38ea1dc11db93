#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/io/program.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <time.h>

#include "commands.hpp"
#include "digits50.hpp"
#include "json_writer.hpp"
#include "mechanism.hpp"
#include "message.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {

struct options {
  reading in;
  std::string frame;
  double seconds = 0.1;
  bool json = false;
};

using list = exact_chain::list;

struct bench_state {
  list q, v, a, tau;
};

/// States that are the same each time: q in the middle half of its limits, or within 1 rad or m of the neutral
/// configuration; v, a and tau within 1.
std::vector<bench_state> states_of(const mechanism& m) {
  const auto& c = m.chain();
  std::mt19937 engine(1);
  const auto any = [&engine] { return static_cast<double>(engine()) * 0x1p-31 - 1; };
  std::vector<bench_state> all(10);
  for (auto& s : all) {
    Eigen::VectorXd step(c.dofs());
    for (auto& x : step) x = any();
    auto q = kte::integrate(c, kte::neutral_configuration(c), step, 1.0);
    for (const auto& e : kte::layout(c)) {
      const auto v = static_cast<std::size_t>(e.v);
      const double low = m.robot.limits.lower[v], high = m.robot.limits.upper[v];
      if (e.nv == 1 && std::isfinite(high - low)) q[e.q] = (low + high) / 2 + step[e.v] * (high - low) / 4;
    }
    s.q.assign(q.data(), q.data() + q.size());
    for (auto* const x : {&s.v, &s.a, &s.tau}) {
      x->resize(static_cast<std::size_t>(c.dofs()));
      for (auto& number : *x) number = any();
    }
  }
  return all;
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The median time of a call of f(state), s, over batches within a budget.
template <class F>
double median_time(const std::vector<bench_state>& states, double budget, const F& f) {
  constexpr int batches = 25;
  std::size_t next = 0;
  const auto run = [&](long long calls) {
    const double before = cpu_seconds();
    for (long long i = 0; i < calls; ++i) f(states[next]), next = next + 1 == states.size() ? 0 : next + 1;
    return cpu_seconds() - before;
  };
  long long calls = 10;
  for (double took = run(calls); took < budget / batches / 4 && calls < 1'000'000'000; took = run(calls)) calls *= 2;
  double once = run(calls);
  calls = std::max(1LL, static_cast<long long>(static_cast<double>(calls) * budget / batches / std::max(once, 1e-9)));
  std::vector<double> times;
  for (int i = 0; i < batches; ++i) times.push_back(run(calls) / static_cast<double>(calls));
  std::nth_element(times.begin(), times.begin() + batches / 2, times.end());
  return times[batches / 2];
}

/// The largest difference, relative to the largest number.
double relative_error(const list& x, const list& exact) {
  double largest = 0, worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    largest = std::max(largest, std::abs(exact[i]));
    worst = std::max(worst, std::abs(x[i] - exact[i]));
  }
  return largest > 0 ? worst / largest : worst;
}

template <class M>
void append(list& out, const M& m) {
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) out.push_back(m(i, j));
}
template <class... M>
list numbers_of(const M&... m) {
  list out;
  (append(out, m), ...);
  return out;
}

/// The frame in space with the most joints below it, of several the last; empty if there is none.
std::string last_frame(const kte::runtime_chain& c) {
  std::map<std::string, int> joints;
  std::string frame;
  int most = 0;
  c.for_each_element([&](const kte::kte_element& e) {
    const auto ports = e.ports();
    if (ports.back().how != kte::access::out || ports.back().what != kte::kind::frame_3D) return;
    int below = kte::is_coordinate(ports.front().what);
    for (std::size_t p = 0; p + 1 < ports.size(); ++p)
      if (kte::is_frame(ports[p].what)) below += joints[e.names()[p]];
    joints[e.names().back()] = below;
    if (below >= most) most = below, frame = e.names().back();
  });
  return frame;
}

struct result {
  std::string operation;
  std::optional<double> seconds, error;
  std::string refused;  ///< why there is no time
};

class bench_run {
 public:
  bench_run(const options& o, const mechanism& m) : o_(o), c_(m.chain()), s_(c_.make_state()), states_(states_of(m)) {
    try {
      exact_ = std::make_unique<exact_chain>(c_, o.frame);
    } catch (const kte::error& e) {
      without_errors = e.what();
    }
  }

  std::vector<result> results;
  std::string without_errors;  ///< why no errors are known

  void all() {
    add(
        "inverse dynamics", [&](const auto& x) -> const auto& { return kte::inverse_dynamics(c_, s_, x.q, x.v, x.a); },
        [](const auto& r) { return numbers_of(r); },
        [](auto& e, const auto& x) { return e.inverse_dynamics(x.q, x.v, x.a); });
    add(
        "forward dynamics",
        [&](const auto& x) -> const auto& { return kte::forward_dynamics(c_, s_, x.q, x.v, x.tau); },
        [](const auto& r) { return numbers_of(r); },
        [](auto& e, const auto& x) { return e.forward_dynamics(x.q, x.v, x.tau); });
    add(
        "mass matrix M", [&](const auto& x) -> const auto& { return kte::mass_matrix(c_, s_, x.q); },
        [](const auto& r) { return numbers_of(r); }, [](auto& e, const auto& x) { return e.mass_matrix(x.q); });
    add(
        "M^-1", [&](const auto& x) -> const auto& { return kte::mass_matrix_inverse(c_, s_, x.q); },
        [](const auto& r) { return numbers_of(r); }, [](auto& e, const auto& x) { return e.mass_matrix_inverse(x.q); });
    add(
        "derivatives of inverse dynamics",
        [&](const auto& x) -> const auto& { return kte::inverse_dynamics_derivatives(c_, s_, x.q, x.v, x.a); },
        [](const auto& r) { return numbers_of(r.by_q, r.by_v); },
        [](auto& e, const auto& x) { return e.inverse_derivatives(x.q, x.v, x.a); });
    add(
        "derivatives of forward dynamics",
        [&](const auto& x) -> const auto& { return kte::forward_dynamics_derivatives(c_, s_, x.q, x.v, x.tau); },
        [](const auto& r) { return numbers_of(r.by_q, r.by_v); },
        [](auto& e, const auto& x) { return e.forward_derivatives(x.q, x.v, x.tau); });
    add(
        "energies", [&](const auto& x) { return kte::energy(c_, s_, x.q, x.v); },
        [](const auto& r) {
          return list{r.kinetic, r.potential};
        },
        [](auto& e, const auto& x) { return e.energy(x.q, x.v); });
    if (o_.frame.empty()) return;
    const auto frame = c_.frame(o_.frame);
    add(
        "pose of " + o_.frame, [&](const auto& x) { return kte::forward_kinematics(c_, s_, x.q, frame); },
        [](const auto& r) {
          list out;
          for (const auto& row : {r.position, r.rotation.x, r.rotation.y, r.rotation.z})
            out.insert(out.end(), {row.x, row.y, row.z});
          return out;
        },
        [](auto& e, const auto& x) { return e.pose(x.q); });
    add(
        "Jacobian of " + o_.frame, [&](const auto& x) { return kte::jacobian(c_, s_, x.q, frame, kte::in_world_axes); },
        [](const auto& r) { return numbers_of(r); }, [](auto& e, const auto& x) { return e.jacobian(x.q); });
  }

 private:
  template <class Call, class Numbers, class Exact>
  void add(const std::string& name, const Call& call, const Numbers& numbers, const Exact& exact) {
    result r{name, {}, {}, ""};
    try {
      if (exact_) {
        double worst = 0;
        for (const auto& x : states_) worst = std::max(worst, relative_error(numbers(call(x)), exact(*exact_, x)));
        r.error = worst;
      }
      r.seconds = median_time(states_, o_.seconds, [&](const auto& x) {
        const auto& y = call(x);
        asm volatile("" : : "r"(&y) : "memory");
      });
    } catch (const kte::error& e) {
      r.refused = e.what(), r.seconds = r.error = {};
    }
    results.push_back(std::move(r));
  }

  const options& o_;
  const kte::runtime_chain& c_;
  kte::runtime_state s_;
  std::vector<bench_state> states_;
  std::unique_ptr<exact_chain> exact_;
};

std::string time_text(double seconds) {
  const double ns = 1e9 * seconds;
  return ns < 1e4 ? short_number(std::round(ns)) + " ns" : short_number(std::round(ns / 10) / 100) + " us";
}

std::string text_of(const mechanism& m, const bench_run& b) {
  std::string s = printable(m.file) + ": " + degrees_text(m.chain().dofs()) +
                  "; medians, CPU time of a call; errors against 50 digits, relative to the largest number\n";
  std::size_t width = 0;
  for (const auto& r : b.results) width = std::max(width, r.operation.size());
  for (const auto& r : b.results) {
    s += "  " + r.operation + std::string(width + 2 - r.operation.size(), ' ');
    char cells[64];
    if (r.seconds) {
      std::snprintf(cells, sizeof cells, "%12s", time_text(*r.seconds).c_str());
      s += cells;
      if (r.error) std::snprintf(cells, sizeof cells, "%10.1e", *r.error), s += cells;
    } else {
      s += printable(r.refused);
    }
    s += '\n';
  }
  return s;
}

std::string json_of(const mechanism& m, const bench_run& b) {
  json_writer j;
  j.object()
      .member("file", m.file)
      .member("nv", m.chain().dofs())
      .member("errors_against", b.without_errors.empty() ? "50 digits" : "");
  j.key("operations").list();
  for (const auto& r : b.results) {
    j.object().member("operation", r.operation).member("seconds", r.seconds.value_or(std::nan("")));
    j.member("error", r.error.value_or(std::nan("")));
    if (!r.refused.empty()) j.member("refused", r.refused);
    j.end();
  }
  return j.end().end().text();
}

int bench(options& o) {
  if (!(o.seconds > 0 && o.seconds <= 3600))
    throw usage_error("--seconds must be greater than 0 and at most 3600, not " + short_number(o.seconds));
  const auto m = read_and_warn(o.in);
  if (m.chain().dofs() == 0) throw kte::bad_argument("kte: " + m.file + " has no degrees of freedom");
  if (o.frame.empty()) {
    o.frame = last_frame(m.chain());
  } else if (m.chain().frame(o.frame).what() != kte::kind::frame_3D) {
    throw kte::bad_argument("kte: the frame '" + o.frame + "' is a frame in the plane");
  }
  bench_run b(o, m);
  b.all();
  if (!b.without_errors.empty()) say("errors are not known here: " + b.without_errors.substr(5));
  kte::detail::write_standard_output(o.json ? json_of(m, b) : text_of(m, b));
  return 0;
}

}  // namespace

void add_bench(command_line& line) {
  const auto o = std::make_shared<options>();
  add_reading(line.add("bench", "measures speed and accuracy of its operations on this machine",
                       "Measures operations on a mechanism on this machine: the median CPU time per call over 25 "
                       "batches, at ten fixed states, and the largest error against 50 digits, relative to the largest "
                       "number. Errors are available for joints, links and inertias. Damping and friction of joints "
                       "are omitted unless --joint-dynamics is given."),
              o->in, false)
      .text("--frame", "NAME", o->frame,
            "frame whose pose and Jacobian are measured; default: the last frame with the most joints to its base")
      .number("--seconds", "S", o->seconds, "time for each operation, s; default 0.1")
      .flag("--json", o->json, "prints JSON")
      .runs([o] { return bench(*o); });
}

}  // namespace kte_tool
