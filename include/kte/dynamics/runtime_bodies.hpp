#pragma once

#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/runtime_frames.hpp>

/// Bodies of runtime chains: bias forces, kinetic energy, centre of mass, momentum, under the names they have on static
/// chains (dynamics/bias_forces.hpp, energy.hpp, centre_of_mass.hpp, centroidal.hpp). Bases stand and are accelerated
/// as the state has them, and otherwise rest. Nothing is allocated but the matrix that `centroidal_map` returns.
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
    for_each_runtime_freedom(state_, [&](auto& c, const freedom& at) {
      auto i = static_cast<std::size_t>(at.v), j = i;
      visit_a(c, [&](double& x) { f(x, state_.work.own_mass[i++]); });
      if (velocities_) visit_v(c, [&](double& x) { f(x, state_.work.rates[j++]); });
    });
  }
  runtime_state& state_;
  bool velocities_;
};

inline const Eigen::VectorXd& applied_forces(runtime_state& s) {
  read_numbers<vector_of::f>(s, s.work.forces);
  s.work.forces = -s.work.forces;
  check_finite(s.work.forces, static_cast<std::size_t>(s.dofs()),
               "kte: a force is no finite number: an argument is none, or is too large");
  return s.work.forces;
}

/// The inertia that an element alone puts on its frame, none if it is no body.
inline composite_3D inertia_of(const topology::connection& e, runtime_state& s) {
  if (e.stiff || e.ports.size() != 1 || !is_frame(e.ports[0].what)) return {};
  auto& carried = e.ports[0].what == kind::frame_2D ? s.work.carried.get<kind::frame_2D>(e.index[0])
                                                    : s.work.carried.get<kind::frame_3D>(e.index[0]);
  carried = {};
  e.element->carry(s);
  return carried;
}
/// Inverse dynamics of the bodies alone, without accelerations of coordinates.
inline void forces_of_bodies(const kte_map_chain& c, runtime_state& s, bool accelerated_bases) {
  auto& w = s.work;
  const auto& elements = c.wiring().elements;
  update_angles(s);
  start(s);
  if (!accelerated_bases)
    for (const auto& [k, i] : w.bases) {
      auto& x = k == kind::frame_2D ? w.frames.get<kind::frame_2D>(i) : w.frames.get<kind::frame_3D>(i);
      x.acceleration = {}, x.ang_acceleration = {};
    }
  for (const int e : w.movers) elements[static_cast<std::size_t>(e)].element->move(s);
  for (auto e = elements.rbegin(); e != elements.rend(); ++e) {
    const composite_3D b = inertia_of(*e, s);
    const bool body = b.mass != 0 || b.inertia.xx != 0 || b.inertia.yy != 0 || b.inertia.zz != 0;
    if (body || e->ports.back().how == access::out) e->element->push(s);
  }
}

/// After mass_of_coordinates: visit(pose of a base, its inertia, first column, last column).
template <class F>
void for_each_base_load(const topology& t, runtime_state& s, const F& visit) {
  auto& w = s.work;
  for (const auto& [k, i] : w.bases) {
    const auto one = [&, index = i]<kind K>(std::integral_constant<kind, K>) {
      const auto m = spatial(s.get<K>(index));
      const pose<mat3<vec3<>>, vec3<>> x{as<double>(matrix(m.rotation)), as<double>(m.position)};
      visit(x, w.carried.get<K>(index), std::size_t{0}, std::size_t{0});
      for (std::size_t e = 0; e < t.elements.size(); ++e) {
        const auto& mover = t.elements[e];
        if (!mover.stiff) continue;
        const std::size_t base = mover.index.size() - 2;
        if (mover.ports[base].what == K && mover.index[base] == index)
          visit(x, composite_3D{}, w.places[e].first, w.places[e].last);
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
  for_each_base_load(t, s, [&sum](const auto& x, const composite_3D& b, std::size_t, std::size_t) {
    sum = {sum.mass + b.mass, sum.moment + (x.rotation * b.moment + b.mass * x.position)};
  });
  return sum;
}
/// visit(row of an axis among all coordinates, momentum of its unit rate about the origin of the world).
template <class F>
void for_each_momentum(const topology& t, runtime_state& s, const F& visit) {
  for_each_base_load(t, s, [&](const auto& x, const composite_3D&, std::size_t first, std::size_t last) {
    const auto& w = s.work.column;
    for (std::size_t k = first; k < last; ++k)
      visit(s.work.row_of_column[k], transmit(x, wrench_3D{{w[0][k], w[1][k], w[2][k]}, {w[3][k], w[4][k], w[5][k]}}));
  });
}
/// Momentum at the origin of the world, after mass_of_coordinates.
inline wrench_3D momentum_of_coordinates(const topology& t, runtime_state& s) {
  auto& rate = s.work.own_mass;  // by row
  for_each_runtime_freedom(s, [&rate](const auto& c, const freedom& at) {
    auto i = static_cast<std::size_t>(at.v);
    visit_v(c, [&](double x) { rate[i++] = x; });
  });
  for (std::size_t i = 0; i < s.work.row_of_gen.size(); ++i)
    rate[static_cast<std::size_t>(s.work.row_of_gen[i])] = s.get<kind::gen>(static_cast<int>(i)).q_dot;
  for (std::size_t i = 0; i < s.work.row_of_gen.size(); ++i)  // given from outside: at rest
    if (s.work.row_of_gen[i] >= t.nv && t.writers[0][i] < 0) rate[static_cast<std::size_t>(s.work.row_of_gen[i])] = 0;
  wrench_3D sum{};
  for_each_momentum(t, s, [&](int row, const wrench_3D& h) {
    const double r = rate[static_cast<std::size_t>(row)];
    sum = {sum.force + r * h.force, sum.torque + r * h.torque};
  });
  return sum;
}
}  // namespace detail

/// As on static chains. The state keeps its velocities and accelerations.
inline const Eigen::VectorXd& static_forces(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_positions(s);
  const detail::rates_aside aside(s, true);
  return inverse_dynamics(c, s);
}
inline const Eigen::VectorXd& gravity_forces(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_positions(s);
  const detail::rates_aside aside(s, true);
  detail::forces_of_bodies(c, s, true);
  return detail::applied_forces(s);
}
inline const Eigen::VectorXd& nonlinear_effects(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_state_velocities(s);
  const detail::rates_aside aside(s, false);
  return inverse_dynamics(c, s);
}
inline const Eigen::VectorXd& coriolis_forces(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_state_velocities(s);
  const detail::rates_aside aside(s, false);
  detail::forces_of_bodies(c, s, false);
  return detail::applied_forces(s);
}

/// By the velocities of all frames.
inline double kinetic_energy(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_state_velocities(s);
  c.doMotion(s);
  double twice = 0;
  auto& w = s.work;
  auto& m = w.coordinates > s.dofs() ? w.all : w.mass;
  for (const auto& e : c.wiring().elements) {
    if (e.stiff || e.ports.back().how == access::out) continue;
    if (const composite_3D b = detail::inertia_of(e, s); is_frame(e.ports[0].what)) {
      twice += detail::with_motion(s, {e.ports[0].what, e.index[0]}, [&b](const auto& x) {
        return as<double>(detail::power(x, detail::accelerating_wrench(b, x)));
      });
    } else if (e.ports[0].what == kind::gen) {
      const int row = w.row_of_gen[static_cast<std::size_t>(e.index[0])];
      const double rate = s.get<kind::gen>(e.index[0]).q_dot;
      m(row, row) = 0;
      e.element->carry_coordinate(s);
      twice += m(row, row) * rate * rate;
    }
  }
  return detail::checked_energy<double>(twice / 2);
}

/// By composite inertias, with those of the mass matrix.
inline mass_centre<> centre_of_mass(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_positions(s);
  detail::mass_of_coordinates(c.wiring(), s);
  const auto w = detail::weight_of(c.wiring(), s);
  return {w.mass, detail::divided_by_mass<double>(w.mass, w.moment)};
}
inline vec3<> centre_of_mass_velocity(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_state_velocities(s);
  detail::mass_of_coordinates(c.wiring(), s);
  return detail::divided_by_mass<double>(detail::weight_of(c.wiring(), s).mass,
                                         detail::momentum_of_coordinates(c.wiring(), s).force);
}
inline linear_angular<> centroidal_momentum(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_state_velocities(s);
  detail::mass_of_coordinates(c.wiring(), s);
  const auto w = detail::weight_of(c.wiring(), s);
  const auto h = detail::momentum_of_coordinates(c.wiring(), s);
  return detail::checked<double>(h.force, h.torque - cross(detail::divided_by_mass<double>(w.mass, w.moment), h.force));
}
inline runtime_jacobian centroidal_map(const kte_map_chain& c, runtime_state& s) {
  c.check(s), detail::check_positions(s);
  const auto& t = c.wiring();
  detail::mass_of_coordinates(t, s);
  const auto w = detail::weight_of(t, s);
  const vec3<> centre = detail::divided_by_mass<double>(w.mass, w.moment);
  runtime_jacobian a = runtime_jacobian::Zero(6, s.work.coordinates);
  detail::for_each_momentum(t, s, [&](int row, const wrench_3D& h) {
    const vec3<> k = h.torque - cross(centre, h.force);
    a(0, row) += h.force.x, a(1, row) += h.force.y, a(2, row) += h.force.z;
    a(3, row) += k.x, a(4, row) += k.y, a(5, row) += k.z;
  });
  if (s.work.coordinates == s.dofs()) return a;
  runtime_jacobian folded(6, s.dofs());  // rows as forces, from followers to what they follow
  for (int i = 0; i < 6; ++i) {
    detail::for_each_runtime_freedom(s, [&](auto& x, const detail::freedom& at) {
      int j = at.v;
      detail::visit_f(x, [&](double& f) { f = a(i, j++); });
    });
    for (std::size_t g = 0; g < s.work.row_of_gen.size(); ++g)
      s.get<kind::gen>(static_cast<int>(g)).f = a(i, s.work.row_of_gen[g]);
    detail::push_followers(t, s);
    detail::read_numbers<detail::vector_of::f>(s, s.work.forces);
    folded.row(i) = s.work.forces.transpose();
  }
  return folded;
}

// The same at q, or q and v, which are put into the state.
template <indexable Q>
const Eigen::VectorXd& static_forces(const kte_map_chain& c, runtime_state& s, const Q& q) {
  set_positions(s, q);
  return static_forces(c, s);
}
template <indexable Q>
const Eigen::VectorXd& gravity_forces(const kte_map_chain& c, runtime_state& s, const Q& q) {
  set_positions(s, q);
  return gravity_forces(c, s);
}
template <indexable Q, indexable V>
const Eigen::VectorXd& nonlinear_effects(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v) {
  set_positions(s, q), set_velocities(s, v);
  return nonlinear_effects(c, s);
}
template <indexable Q, indexable V>
const Eigen::VectorXd& coriolis_forces(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v) {
  set_positions(s, q), set_velocities(s, v);
  return coriolis_forces(c, s);
}
template <indexable Q, indexable V>
double kinetic_energy(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v) {
  set_positions(s, q), set_velocities(s, v);
  return kinetic_energy(c, s);
}
template <indexable Q>
mass_centre<> centre_of_mass(const kte_map_chain& c, runtime_state& s, const Q& q) {
  set_positions(s, q);
  return centre_of_mass(c, s);
}
template <indexable Q, indexable V>
vec3<> centre_of_mass_velocity(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v) {
  set_positions(s, q), set_velocities(s, v);
  return centre_of_mass_velocity(c, s);
}
template <indexable Q, indexable V>
linear_angular<> centroidal_momentum(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v) {
  set_positions(s, q), set_velocities(s, v);
  return centroidal_momentum(c, s);
}
template <indexable Q>
runtime_jacobian centroidal_map(const kte_map_chain& c, runtime_state& s, const Q& q) {
  set_positions(s, q);
  return centroidal_map(c, s);
}

}  // namespace kte
