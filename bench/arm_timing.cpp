#include "arm_timing.hpp"

#include <kte/manipulators/iiwa14.hpp>
#include <kte/manipulators/inverse_kinematics.hpp>
#include <kte/manipulators/three_r_three_r.hpp>
#include <kte/manipulators/ur.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "yardstick.hpp"

namespace bench {
namespace {

template <class Arm>
arm_numbers arm_numbers_of(const Arm& arm) {
  const auto& limits = arm.limits();
  return {arm.structure().original,
          arm.structure().reach,
          {limits.lower.begin(), limits.lower.end()},
          {limits.upper.begin(), limits.upper.end()}};
}

template <class S>
auto pose_at(const arm_numbers& arm, const double* q) {
  std::array<S, kte::detail::arm_geometry::most> t{};
  std::copy_n(q, arm.geometry.n, t.begin());
  return kte::detail::tool_pose(arm.geometry, t);
}

struct questions {
  std::vector<std::vector<double>> postures, starts;
  std::vector<arm_question> all;
};
questions ask(const std::string& model) {
  const arm_numbers& arm = arm_of(model);
  std::mt19937 random(1);
  const auto draw = [&] {
    std::vector<double> q;
    for (std::size_t i = 0; i < arm.lower.size(); ++i)
      q.push_back(std::uniform_real_distribution<>(arm.lower[i], arm.upper[i])(random));
    return q;
  };
  questions out;
  for (int k = 0; k < 512; ++k) {
    const auto& q = out.postures.emplace_back(draw());
    const auto& start = out.starts.emplace_back(draw());
    const auto [R, p] = pose_at<double>(arm, q.data());
    const double angle = model == "iiwa14" ? kte::arm_angle_of(kte::iiwa14(), q) : 0;
    out.all.push_back(
        {{R.x.x, R.x.y, R.x.z, R.y.x, R.y.y, R.y.z, R.z.x, R.z.y, R.z.z}, {p.x, p.y, p.z}, start.data(), angle});
  }
  return out;
}

/// The error of the position relative to the reach, or of the rotation, rad.
double error_of(const arm_numbers& arm, const double* q, const arm_question& x) {
  const auto [R, p] = pose_at<long double>(arm, q);
  const auto& r = x.rotation;
  const kte::mat3<kte::vec3<long double>> wanted{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
  const kte::vec3<long double> d = p - kte::vec3<long double>{x.position[0], x.position[1], x.position[2]};
  const auto e = R - wanted;
  const auto turn = std::sqrt((dot(e.x, e.x) + dot(e.y, e.y) + dot(e.z, e.z)) / 2);
  return static_cast<double>(std::max(std::sqrt(dot(d, d)) / static_cast<long double>(arm.reach), turn));
}
/// But for whole turns.
bool same_posture(const double* a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < b.size(); ++i)
    if (!(std::fabs(std::remainder(a[i] - b[i], 2 * M_PI)) < 1e-6)) return false;
  return true;
}

void time(benchmark::State& state, const std::string& model, answer_kind what, answer_call f, std::size_t together) {
  const arm_numbers& arm = arm_of(model);
  const questions asked = ask(model);
  std::vector<double> q(together * room_for_answers);
  std::vector<int> count(together);
  double error = 0, found = 0, answers = 0;
  for (std::size_t k = 0; k < asked.all.size(); ++k) {
    const std::size_t one = k % together;
    if (one == 0) f(&asked.all[k], q.data(), count.data());
    bool known = false;
    for (int i = 0; i < count[one]; ++i) {
      const double* at = q.data() + one * room_for_answers + i * arm.geometry.n;
      const double e = error_of(arm, at, asked.all[k]);
      error = e >= error || e != e ? e : error;
      known |= what == answer_kind::any || same_posture(at, asked.postures[k]);
    }
    found += known, answers += count[one];
  }
  std::size_t next = 0;
  const against_yardstick here(state);
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(together))) {
    f(&asked.all[next], q.data(), count.data());
    benchmark::ClobberMemory();
    next = (next + together) % asked.all.size();
  }
  const auto all = static_cast<double>(asked.all.size());
  state.counters["error"] = error;
  state.counters["found"] = found / all;
  state.counters["answers"] = answers / all;
}

}  // namespace

const arm_numbers& arm_of(const std::string& model) {
  static const std::map<std::string, arm_numbers> all{{"3R3R", arm_numbers_of(kte::three_r_three_r())},
                                                      {"ur5", arm_numbers_of(kte::ur())},
                                                      {"iiwa14", arm_numbers_of(kte::iiwa14())}};
  return all.at(model);
}

void add_arm(const std::string& how, const std::string& model, answer_kind what, answer_call f, std::size_t together) {
  benchmark::RegisterBenchmark(("inverse_kinematics/" + how + "/" + model).c_str(),
                               [=](benchmark::State& state) { time(state, model, what, f, together); });
}

}  // namespace bench
