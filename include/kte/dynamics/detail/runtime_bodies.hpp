#pragma once

#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/runtime_frames.hpp>

/// Loops over the bodies of runtime chains, in the working memory of a state.
namespace kte {

namespace detail {

/// Puts accelerations, and on request velocities, of a state aside for as long as it lives.
class rates_aside {
 public:
  rates_aside(runtime_state& s, bool velocities) : state_(s), velocities_(velocities) {
    each([](double& x, double& kept) { kept = x, x = 0; });
  }
  ~rates_aside() {
    each([](double& x, const double& kept) { x = kept; });
  }
  rates_aside(const rates_aside&) = delete;
  rates_aside& operator=(const rates_aside&) = delete;

 private:
  template <class F>
  void each(const F& f) {
    for_each_listed_freedom(state_, [&](auto& c, const freedom& at) {
      auto i = static_cast<std::size_t>(at.v), j = i;
      visit_a(c, [&](double& x) { f(x, state_.work.own_mass[i++]); });
      if (velocities_) visit_v(c, [&](double& x) { f(x, state_.work.rates[j++]); });
    });
  }
  runtime_state& state_;
  bool velocities_;
};

inline const Eigen::VectorXd& applied_forces(runtime_state& s) {
  read_listed_numbers<vector_of::f>(s, s.work.forces);
  s.work.forces = -s.work.forces;
  check_result(s.work.forces, static_cast<std::size_t>(s.dofs()), [&s] { blame("a force", s); });
  return s.work.forces;
}

/// The inertia that an element alone puts on its frame, none if it is no body.
inline dense_composite<double> inertia_of(const topology::connection& e, runtime_state& s) {
  if (e.stiff || e.ports.size() != 1 || !is_frame(e.ports[0].what)) return {};
  auto& carried = e.ports[0].what == kind::frame_2D ? s.work.carried.get<kind::frame_2D>(e.index[0])
                                                    : s.work.carried.get<kind::frame_3D>(e.index[0]);
  carried = {};
  e.element->perform(steps::carry{}, s);
  return carried;
}
/// Inverse dynamics of the bodies alone, without accelerations of coordinates.
inline void forces_of_bodies(const kte_map_chain& c, runtime_state& s, bool accelerated_bases) {
  check_plain_loads(c);
  auto& w = s.work;
  const auto& elements = c.wiring().elements;
  update_angles(s);
  start(s);
  if (!accelerated_bases)
    for (const auto& [k, i] : s.plan.bases) {
      auto& x = k == kind::frame_2D ? w.frames.get<kind::frame_2D>(i) : w.frames.get<kind::frame_3D>(i);
      x.acceleration = {}, x.ang_acceleration = {};
    }
  for (const int e : s.plan.movers) elements[static_cast<std::size_t>(e)].element->perform(steps::move{}, s);
  for (auto e = elements.rbegin(); e != elements.rend(); ++e) {
    const dense_composite<double> b = inertia_of(*e, s);
    const bool body = b.mass != 0 || b.inertia.xx != 0 || b.inertia.yy != 0 || b.inertia.zz != 0;
    if (body || e->ports.back().how == access::out) e->element->perform(steps::push{}, s);
  }
}

/// After mass_of_coordinates: visit(pose of a base, its inertia, first column, last column).
template <class F>
void for_each_base_load(const topology& t, runtime_state& s, const F& visit) {
  auto& w = s.work;
  for (const auto& [k, i] : s.plan.bases) {
    const auto one = [&, index = i]<kind K>(std::integral_constant<kind, K>) {
      const auto m = spatial(s.get<K>(index));
      const pose<mat3<vec3<>>, vec3<>> x{as<double>(matrix(m.rotation)), as<double>(m.position)};
      visit(x, w.carried.get<K>(index), std::size_t{0}, std::size_t{0});
      for (std::size_t e = 0; e < t.elements.size(); ++e) {
        const auto& mover = t.elements[e];
        if (!mover.stiff) continue;
        const std::size_t from = mover.index.size() - 2;
        if (mover.ports[from].what == K && mover.index[from] == index)
          visit(x, dense_composite<double>{}, s.plan.places[e].first, s.plan.places[e].last);
      }
    };
    if (k == kind::frame_2D)
      one(std::integral_constant<kind, kind::frame_2D>{});
    else
      one(std::integral_constant<kind, kind::frame_3D>{});
  }
}
inline weighted_point<double, vec3<>> weight_of(const topology& t, runtime_state& s) {
  weighted_point<double, vec3<>> sum{};
  for_each_base_load(t, s, [&sum](const auto& x, const dense_composite<double>& b, std::size_t, std::size_t) {
    sum = {sum.mass + b.mass, sum.moment + (x.rotation * b.moment + b.mass * x.position)};
  });
  return sum;
}
/// visit(row of an axis among all coordinates, momentum of its unit rate about the origin of the world).
template <class F>
void for_each_momentum(const topology& t, runtime_state& s, const F& visit) {
  for_each_base_load(t, s, [&](const auto& x, const dense_composite<double>&, std::size_t first, std::size_t last) {
    const auto& w = s.work.column;
    for (std::size_t k = first; k < last; ++k)
      visit(s.work.row_of_column[k],
            transmit(x, dense_wrench<double>{{w[0][k], w[1][k], w[2][k]}, {w[3][k], w[4][k], w[5][k]}}));
  });
}
/// Momentum at the origin of the world, after mass_of_coordinates.
inline dense_wrench<double> momentum_of_coordinates(const topology& t, runtime_state& s) {
  auto& rate = s.work.own_mass;  // by row
  for_each_listed_freedom(s, [&rate](const auto& c, const freedom& at) {
    auto i = static_cast<std::size_t>(at.v);
    visit_v(c, [&](double x) { rate[i++] = x; });
  });
  for (std::size_t i = 0; i < s.plan.row_of_gen.size(); ++i)
    rate[static_cast<std::size_t>(s.plan.row_of_gen[i])] = s.get<kind::gen>(static_cast<int>(i)).q_dot;
  for (std::size_t i = 0; i < s.plan.row_of_gen.size(); ++i)  // given from outside: at rest
    if (s.plan.row_of_gen[i] >= t.nv && t.writers[0][i] < 0) rate[static_cast<std::size_t>(s.plan.row_of_gen[i])] = 0;
  dense_wrench<double> sum{};
  for_each_momentum(t, s, [&](int row, const dense_wrench<double>& h) {
    const double r = rate[static_cast<std::size_t>(row)];
    sum = {sum.force + r * h.force, sum.torque + r * h.torque};
  });
  return sum;
}
}  // namespace detail

}  // namespace kte
