/// MuJoCo's RK4 on some of the problems: lines as of kte_work_precision, with the method `mujoco_RK4`.
#include <algorithm>
#include <cmath>

#include "data/problems/double_pendulum.hpp"
#include "data/problems/dzhanibekov.hpp"
#include "data/problems/iiwa14_free_swing.hpp"
#include "data/problems/pendulum.hpp"
#include "mechanism.hpp"
#include "mujoco_model.hpp"
#include "rows.hpp"

namespace {

using namespace work_precision;
using namespace kte::problems;

/// State: positions and velocities of all joints; quaternions and rates are as kte has them.
template <class X>
class mujoco_run final : public contender {
 public:
  mujoco_run(const bench::serial_robot& robot, const task<X>& t)
      : contender("mujoco_RK4", 2), model_(load_mujoco(robot)), data_(mj_makeData(model_)), task_(t) {}
  ~mujoco_run() override { mj_deleteData(data_), mj_deleteModel(model_); }

  void integrate(double step) override {
    mj_resetData(model_, data_);
    std::copy_n(task_.start.data(), model_->nq, data_->qpos);
    std::copy_n(task_.start.data() + model_->nq, model_->nv, data_->qvel);
    model_->opt.timestep = step;
    const long long steps = std::llround(task_.t_end / step);
    for (long long i = 0; i < steps; ++i) mj_step(model_, data_);
    cost = {.steps = steps, .evaluations = 4 * steps};
  }
  judgement judge() const override {
    X x;
    std::copy_n(data_->qpos, model_->nq, x.data());
    std::copy_n(data_->qvel, model_->nv, x.data() + model_->nq);
    return task_.judge(x);
  }

 private:
  mjModel* model_;
  mjData* data_;
  task<X> task_;
};

template <class X>
void add(std::vector<problem>& all, const char* name, const bench::serial_robot& robot, const task<X>& t) {
  auto& p = all.emplace_back(problem{name, t.t_end, t.t_end / 0.01});
  p.contenders.push_back(std::make_unique<mujoco_run<X>>(robot, t));
}

/// A body on a joint at a point of the body before; its centre of mass on its x axis.
bench::serial_link body(double at_x, const Eigen::Vector3d& axis, double mass, double com_x,
                        const Eigen::Vector3d& inertia) {
  return {Eigen::Matrix3d::Identity(), {at_x, 0, 0}, axis, mass, {com_x, 0, 0}, inertia.asDiagonal()};
}
bench::serial_robot robot(const Eigen::Vector3d& gravity, std::vector<bench::serial_link> links) {
  return {std::move(links), gravity, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
}
Eigen::Vector3d all_axes(double i) { return Eigen::Vector3d::Constant(i); }

}  // namespace

// MuJoCo refuses points, so pendulums are of bodies that move alike: of equal moments int r dm and int r^2 dm, as
// tests/data/problems/spherical_double_pendulum.hpp explains.
int main(int count, char** texts) {
  const bool quick = count > 1 && std::string(texts[1]) == "--quick";
  const Eigen::Vector3d z{0, 0, 1}, down{9.81, 0, 0};
  const auto double_pendulum =
      robot(down, {body(0, z, 1, 0.5, all_axes(0.25)), body(1, z, 1.5, 2.0 / 3, all_axes(1.0 / 3))});
  std::vector<problem> all;
  add(all, "pendulum", robot(down, {body(0, z, 2, 0.25, all_axes(0.125))}), task_of_mechanism<pendulum>());
  add(all, "double_pendulum_2_rad", double_pendulum, task_of_mechanism<double_pendulum_from_2_rad>());
  add(all, "double_pendulum_horizontal", double_pendulum, task_of_mechanism<double_pendulum_from_horizontal>());
  add(all, "dzhanibekov", robot({0, 0, 0}, {body(0, {0, 0, 0}, 1, 0, {1, 2, 3})}),
      task_of_mechanism<dzhanibekov>(3, 9, equation_of_motion<dzhanibekov>::angular_momentum));
  add(all, "iiwa14", bench::robot_of("iiwa14"), task_of_mechanism<iiwa14_free_swing>(14));
  for (const problem& p : all)
    for (const row& r : measure(p, {.quick = quick, .longest = 0.8})) print(p, r);
}
