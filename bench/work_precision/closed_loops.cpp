#include <kte/dynamics/energy.hpp>

#include <deque>

#include "closed_loops/linkages.hpp"
#include "contest.hpp"
#include "data/problems/andrews.hpp"
#include "equations.hpp"

namespace work_precision {

namespace {

using namespace kte::test::loops;
using loop_model = kte::manipulator_dynamics_model<kte::runtime_chain>;

/// A mechanism with loops from q and v, by the methods that are for these. Models live as long as the program.
class closed_loop_problems {
 public:
  explicit closed_loop_problems(std::vector<problem>& all) : all_(all) {}

  /// `error`: of q and v at the end; energies are compared with the start, unless there are dampers.
  void add(const std::string& name, const kte::runtime_chain& c, const vector& q, const vector& v, double t_end,
           double steps, const std::function<double(const vector& q, const vector& v)>& error, bool damped = false) {
    static std::deque<loop_model> models;
    auto& m = models.emplace_back(c);
    const task<Eigen::VectorXd> t{m.make_x(q, v), t_end, [&m, q, v, error, damped](const Eigen::VectorXd& x) {
                                    auto s = m.chain().make_state();
                                    const vector at = m.positions_of(x), rates = m.velocities_of(x);
                                    const auto total = [](const kte::energies<>& e) { return e.kinetic + e.potential; };
                                    const double gained = damped ? none
                                                                 : total(kte::energy(m.chain(), s, at, rates)) -
                                                                       total(kte::energy(m.chain(), s, q, v));
                                    return judgement{error(at, rates), gained, none, none};
                                  }};
    auto& p = all_.emplace_back(problem{"closed_loops_" + name, t_end, steps});
    const entrants<loop_model, Eigen::VectorXd> those(p, m, t);
    those.add<kte::dormand_prince45>("dormand_prince45");
    those.add<kte::prince_dormand87>("prince_dormand87");
    those.add<kte::runge_kutta4>("runge_kutta4");
  }
  /// With the error of all coordinates from a reference by the tightest tolerances.
  void add(const std::string& name, const kte::runtime_chain& c, const vector& q, const vector& v, double t_end,
           double steps) {
    loop_model m(c);
    kte::prince_dormand87 exact(std::cref(m), 0.0, m.make_x(q, v), {.absolute = 1e-13, .relative = 1e-13});
    exact.integrate(t_end);
    const vector end = m.positions_of(exact.state());
    add(name, c, q, v, t_end, steps,
        [c, end](const vector& at, const vector&) { return kte::difference(c, end, at).cwiseAbs().maxCoeff(); });
  }

 private:
  std::vector<problem>& all_;
};

vector at_rest(const kte::runtime_chain& c) { return vector::Zero(c.dofs()); }

}  // namespace

void add_closed_loops(std::vector<problem>& all) {
  closed_loop_problems loops(all);
  const auto of_first = [](double exact) {
    return [exact](const vector& q, const vector&) { return std::abs(q[0] - exact); };
  };
  loops.add("pendulum", pendulum(), numbers({-1, 0}), numbers({0, 0}), 10, 1000, [](const vector& q, const vector&) {
    return std::hypot(q[0] + 0.275087462576117, q[1] + 0.961419205099125);
  });
  for (const int n : {1, 10, 40}) {
    const double angle = pi / 2 - four_bar_angle(n, 0, 1, 10);
    loops.add("four_bars_" + std::to_string(n), four_bars(n), four_bar_q(n, 0), four_bar_v(n, 1), 10, 2000,
              of_first(angle));
  }
  {
    const auto c = andrews();
    auto s = c.make_state();
    const auto q = kte::assemble(c, s, andrews_start(), kte::held("q1"));
    const double end = static_cast<double>(kte::problems::andrews<>::reference[0]);
    loops.add("andrews", c, q, at_rest(c), 0.03, 100, of_first(end));
  }
  {
    const auto c = bennett();
    auto s = c.make_state();
    const auto q = kte::assemble(c, s, numbers({0.8, 1.5, -0.8}), kte::held("q1"));
    loops.add("bennett", c, q, at_rest(c), 5, 500);
  }
  loops.add("slider_crank", slider_crank_of_equal_bars(), numbers({pi / 4, -pi / 2}),
            numbers({2 * std::sqrt(2.0), -4 * std::sqrt(2.0)}), 5, 500,
            of_first(slider_crank_angle(pi / 4, 2 * std::sqrt(2.0), 5)));
  {
    const auto c = cut_governor();
    auto s = c.make_state();
    vector v = at_rest(c);
    const double w = 2 * pi;
    v[0] = w;
    for (const int rod : {2, 8}) v.segment(rod, 6) = numbers({0, w * 0.05, 0, -w * 0.5, 0, w * std::cos(pi / 6)});
    const vector q = cut_governor_q(), closed = kte::consistent_velocities(c, s, q, v);
    loops.add(
        "governor", c, q, closed, 1, 8000,
        [](const vector& at, const vector&) { return std::abs(at[1] - 0.501420922379568); }, true);
  }
  {
    const auto c = stewart();
    auto s = c.make_state();
    loops.add("stewart", c, kte::assemble(c, s, stewart_guess(c)), at_rest(c), 1, 500);
  }
  {
    const auto c = delta();
    auto s = c.make_state();
    loops.add("delta", c, kte::assemble(c, s, delta_guess(), kte::held("q0", "q1", "q2")), at_rest(c), 0.3, 100);
  }
  {
    const auto c = ankle();
    auto s = c.make_state();
    loops.add("ankle", c, kte::assemble(c, s, numbers({0.1, 0.05, 0.1, 0.1}), kte::held("pitch", "roll")), at_rest(c),
              1, 500);
  }
}

}  // namespace work_precision
