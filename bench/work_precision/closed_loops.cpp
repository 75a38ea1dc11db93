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
  void add(const std::string& name, const kte::runtime_chain& c, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
           double t_end, double steps,
           const std::function<double(const Eigen::VectorXd& q, const Eigen::VectorXd& v)>& error,
           bool damped = false) {
    static std::deque<loop_model> models;
    auto& m = models.emplace_back(c);
    const task<Eigen::VectorXd> t{m.make_x(q, v), t_end, [&m, q, v, error, damped](const Eigen::VectorXd& x) {
                                    auto s = m.chain().make_state();
                                    const Eigen::VectorXd at = m.positions_of(x), rates = m.velocities_of(x);
                                    const auto total = [](const kte::energies<>& e) { return e.kinetic + e.potential; };
                                    const double gained = damped ? none
                                                                 : total(kte::energy(m.chain(), s, at, rates)) -
                                                                       total(kte::energy(m.chain(), s, q, v));
                                    return judgement{error(at, rates), gained, none, none};
                                  }};
    auto& p = all_.emplace_back(problem{"closed_loops_" + name, t_end, steps, 3});
    const entrants<loop_model, Eigen::VectorXd> those(p, m, t);
    those.add<kte::dormand_prince45>("dormand_prince45");
    those.add<kte::prince_dormand87>("prince_dormand87");
    those.add<kte::runge_kutta4>("runge_kutta4");
  }

 private:
  std::vector<problem>& all_;
};

Eigen::VectorXd at_rest(const kte::runtime_chain& c) { return Eigen::VectorXd::Zero(c.dofs()); }

}  // namespace

void add_closed_loops(std::vector<problem>& all) {
  closed_loop_problems loops(all);
  const auto of = [](Eigen::Index i, double exact) {
    return [i, exact](const Eigen::VectorXd& q, const Eigen::VectorXd&) { return std::abs(q[i] - exact); };
  };
  loops.add("pendulum", pendulum(), numbers({-1, 0}), numbers({0, 0}), 10, 1000,
            [](const Eigen::VectorXd& q, const Eigen::VectorXd&) {
              return std::hypot(q[0] + 0.275087462576117, q[1] + 0.961419205099125);
            });
  for (const int n : {1, 10, 40}) {
    const double angle = pi / 2 - four_bar_angle(n, 0, 1, 10);
    loops.add("four_bars_" + std::to_string(n), four_bars(n), four_bar_q(n, 0), four_bar_v(n, 1), 10, 2000,
              of(0, angle));
  }
  {
    const auto c = andrews();
    auto s = c.make_state();
    const auto q = kte::assemble(c, s, andrews_start(), kte::held("q1"));
    const double end = static_cast<double>(kte::problems::andrews<>::reference[0]);
    loops.add("andrews", c, q, at_rest(c), 0.03, 100, of(0, end));
  }
  // these by kte's tightest tolerances, 1e-13 and 1e-14, as far as both agree
  {
    const auto c = bennett();
    auto s = c.make_state();
    const Eigen::VectorXd q = kte::assemble(c, s, numbers({0.8, 1.5, -0.8}), kte::held("q1"));
    const Eigen::VectorXd v = kte::consistent_velocities(c, s, q, numbers({2, 0, 0}));
    loops.add("bennett", c, q, v, 5, 500, of(0, 0.07296197142268));
  }
  loops.add("slider_crank", slider_crank_of_equal_bars(), numbers({pi / 4, -pi / 2}),
            numbers({2 * std::sqrt(2.0), -4 * std::sqrt(2.0)}), 5, 500,
            of(0, slider_crank_angle(pi / 4, 2 * std::sqrt(2.0), 5)));
  {
    const auto c = cut_governor();
    auto s = c.make_state();
    Eigen::VectorXd v = at_rest(c);
    const double w = 2 * pi;
    v[0] = w;
    for (const int rod : {2, 8}) v.segment(rod, 6) = numbers({0, w * 0.05, 0, -w * 0.5, 0, w * std::cos(pi / 6)});
    const Eigen::VectorXd q = cut_governor_q(), closed = kte::consistent_velocities(c, s, q, v);
    loops.add("governor", c, q, closed, 1, 8000, of(1, 0.501420922379568), true);
  }
  {
    const auto c = stewart();
    auto s = c.make_state();
    const Eigen::VectorXd q = kte::assemble(c, s, stewart_guess(c));
    loops.add("stewart", c, q, at_rest(c), 1, 500, of(2, 1.13355554986051));  // the length of the first leg
  }
  {
    const auto c = delta();
    auto s = c.make_state();
    const Eigen::VectorXd q = kte::assemble(c, s, delta_guess(), kte::held("q0", "q1", "q2"));
    loops.add("delta", c, q, at_rest(c), 0.3, 100, of(2, -1.06650101763258));  // the height of the platform
  }
  {
    const auto c = ankle();
    auto s = c.make_state();
    const Eigen::VectorXd q = kte::assemble(c, s, numbers({0.1, 0.05, 0.1, 0.1}), kte::held("pitch", "roll"));
    loops.add("ankle", c, q, at_rest(c), 1, 500, of(0, 0.089595675939237));
  }
}

}  // namespace work_precision
