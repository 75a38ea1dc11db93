#pragma once

#include <kte/dynamics/closed_loops/loop_variations.hpp>
#include <kte/dynamics/contacts/contact_dynamics.hpp>

/// Derivatives of the equations of a chain with contacts, in the modes of a solution, by q, along the numbers of v, and
/// by v: as those of loops (closed_loops/loop_variations.hpp).
namespace kte::detail {

/// A contact with a force, in the mode of a solution, with its unknowns x and its equations. With the gap g, normal n,
/// velocity u and force f of contact/contact_geometry.hpp:
///
///   sticks              x = f          u' + (g'' - n . u') n = 0                                   (1)
///   slides              x = lambda_n   g'' = 0,   f = lambda_n (n - mu d),   d = u_t/|u_t|          (2)
///   begins to slide     x = f          g'' = 0,   u_t' + |u_t'| f_t/(mu lambda_n) = 0               (3)
///
/// In the plane, contacts that begin to slide have a given d. Without friction f = lambda_n n.
struct contact_in_mode {
  enum class equations { sticks, slides, slides_along, begins } kind{};
  int closure = 0;       ///< its number among closures and contacts
  std::size_t slot = 0;  ///< its number among contacts
  bool planar = false;
  double friction = 0;
  contact_basis<> basis{};  ///< n, t
  vec3<> force{};
  vec3<> direction{};  ///< d
  vec3<> slip_rate{};  ///< u', found by `vary`
  int first = 0;       ///< its first unknown

  double pressure() const { return dot(basis[0], force); }
  int count() const { return kind == equations::sticks || kind == equations::begins ? (planar ? 2 : 3) : 1; }
  /// The force with derivatives, for constant unknowns.
  template <class D>
  vec3<D> force_at(const basic_touch<D>& x) const {
    if (kind != equations::slides && kind != equations::slides_along) return as<D>(force);
    const D load(pressure());
    if (kind == equations::slides) {
      const vec3<D> t = as<D>(x.slip - dot(x.normal, x.slip) * x.normal);
      using std::sqrt;
      return as<D>(load * (x.normal - D(D(friction) / D(sqrt(D(dot(t, t))))) * t));
    }
    const D side(friction * (direction.x * basis[0].y - direction.y * basis[0].x));
    return as<D>(load * (x.normal - side * vec3<D>{x.normal.y, D(-x.normal.x), D(0)}));
  }
  /// Calls put(row, value) for the equations.
  template <class D, class Put>
  void each_equation(const basic_touch<D>& x, const Put& put) const {
    using std::sqrt;
    const D apart = D(dot(x.normal, x.slip_rate) + x.bending);
    if (kind != equations::sticks) put(0, apart);
    if (kind == equations::slides || kind == equations::slides_along) return;
    vec3<D> rows = as<D>(x.slip_rate + x.bending * x.normal);
    if (kind == equations::begins) {
      const vec3<D> f = as<D>(force), along = as<D>(x.slip_rate - dot(x.normal, x.slip_rate) * x.normal);
      const D load = D(dot(x.normal, f));
      rows = as<D>(along + D(D(sqrt(D(dot(along, along)))) / D(D(friction) * load)) * (f - load * x.normal));
    }
    for (int k = kind == equations::begins; k < count(); ++k)
      put(k, D(dot(as<D>(basis[static_cast<std::size_t>(k)]), rows)));
  }
};

/// The contacts with forces at a state after `contact_dynamics`.
inline std::vector<contact_in_mode> contacts_in_modes(const contact_solver& m, const runtime_state& s, int first) {
  using equations = contact_in_mode::equations;
  std::vector<contact_in_mode> all;
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    if (m.modes[i] == contact_mode::open) continue;
    const auto& x = m.touched(i);
    const auto& found = s.get<kind::contact>(x.slot);
    contact_in_mode c;
    c.closure = x.closure, c.slot = static_cast<std::size_t>(x.slot), c.planar = x.planar;
    c.friction = x.place.law.friction, c.basis = x.basis, c.force = found.force, c.direction = found.direction;
    c.kind = m.modes[i] == contact_mode::sticks ? equations::sticks
             : m.laws[i].sliding                ? equations::slides
             : x.planar || !(c.friction > 0)    ? equations::slides_along
                                                : equations::begins;
    if (!(c.friction > 0)) c.kind = equations::slides_along;
    c.first = first, first += c.count();
    all.push_back(c);
  }
  return all;
}

/// The wrench on the body of a contact, in axes of its frame, by a force at a point in axes of the surface.
template <class D>
tree::dense_wrench<D> wrench_at_contact(const closing_motion<D>& m, const vec3<D>& force, const vec3<D>& point) {
  const auto back = transpose(m.rotation);
  return {as<D>(back * force), as<D>(back * cross(point - m.position, force))};
}

/// Adds a force on the body of a contact at a point, and the opposite on its surface, to the loads of bodies; force and
/// point in axes of the surface.
template <class D>
void push_at_contact(const runtime_state& s, const closure_place& x, const closing_motion<D>& m, const vec3<D>& force,
                     const vec3<D>& point, std::vector<tree::dense_wrench<D>>& loads) {
  const auto& f = s.tree().body_tree;
  add_load(f.frame(x.frame2.what, x.frame2.index), wrench_at_contact(m, force, point), loads);
  add_load(f.frame(x.frame1.what, x.frame1.index), tree::dense_wrench<D>{as<D>(-force), as<D>(-cross(point, force))},
           loads);
}

/// Derivatives at constant accelerations, closure forces and unknowns of contacts.
struct contact_variations {
  Eigen::MatrixXd forces_by_q, forces_by_v;        ///< of inverse dynamics - J^T f
  Eigen::MatrixXd equations_by_q, equations_by_v;  ///< of closures, rows in m divided by the length, and contacts
  std::vector<std::array<Eigen::MatrixXd, 2>> contact_forces;  ///< of f, by q and by v

  contact_variations(Eigen::Index dofs, int equations, std::size_t contacts)
      : equations_by_q(Eigen::MatrixXd::Zero(equations, dofs)),
        equations_by_v(equations_by_q),
        contact_forces(contacts, {Eigen::MatrixXd::Zero(3, dofs), Eigen::MatrixXd::Zero(3, dofs)}) {}
  Eigen::MatrixXd& equations(vector_of by) { return by == vector_of::q ? equations_by_q : equations_by_v; }
};

/// `vary_contacts` with all bodies in dual numbers.
inline contact_variations vary_contacts_in_duals(const runtime_chain& c, runtime_state& s,
                                                 const closure_places* closures, const closure_places& places,
                                                 std::vector<contact_in_mode>& contacts, int equations) {
  using D = derivative_number;
  const Eigen::Index n = s.dofs();
  contact_variations r(n, equations, contacts.size());
  inverse_dynamics_result<double, Eigen::Dynamic> forces;
  forces.tau.resize(n), forces.by_q.setZero(n, n), forces.by_v.setZero(n, n);
  derivative_state& d = state_in_duals(c, s);
  const auto derive = [&](const directions& moving) -> const auto& {
    auto& rows = r.equations(moving.by);
    const auto put = [&](auto&& row, const D& x, double scale = 1) {
      for (int k = 0; k < D::variables && moving.first + k < n; ++k)
        row[moving.first + k] = scale * x.derivative[static_cast<std::size_t>(k)];
    };
    inverse_dynamics_in_duals(runtime_elements{c}, s, d, moving, [&](derivative_state&) {
      if (closures != nullptr)
        closures_in_duals(c, s, *closures, d).push([&](int row, const D&, const D& acceleration) {
          const auto& x = closures->closure_of_row(row);
          put(rows.row(row), acceleration, closures->scale(x, row - x.first));
        });
      for (std::size_t i = 0; i < contacts.size(); ++i) {
        auto& x = contacts[i];
        const auto& at = places.closures[static_cast<std::size_t>(x.closure)];
        const auto m = closing_motion_in_duals(s, d, at);
        const auto found = runtime_elements{c}.element(at.element).touch_at(m);
        x.slip_rate = values_of(found.slip_rate);
        x.each_equation(found, [&](int row, const D& value) { put(rows.row(x.first + row), value); });
        const vec3<D> force = x.force_at(found);
        auto& of_force = r.contact_forces[i][moving.by == vector_of::q ? 0 : 1];
        put(of_force.row(0), force.x), put(of_force.row(1), force.y), put(of_force.row(2), force.z);
        push_at_contact(s, at, m, force, found.point, d.work.loads);
      }
    });
    return d.forces;
  };
  derive_by_duals(s.freedoms(), std::span(d.q), std::span(d.v), std::span(d.a), false, derive, forces);
  r.forces_by_q = std::move(forces.by_q), r.forces_by_v = std::move(forces.by_v);
  return r;
}
/// `vary_contacts` along the paths of closures and contacts.
inline contact_variations vary_contacts_along_paths(const runtime_chain& c, runtime_state& s,
                                                    const closure_places* closures, const closure_places& places,
                                                    std::vector<contact_in_mode>& contacts, int equations) {
  using D = derivative_number;
  contact_variations r(s.dofs(), equations, contacts.size());
  const auto& forces = forces_derived(c, s);
  r.forces_by_q = forces.by_q, r.forces_by_v = forces.by_v;
  closure_path path;
  if (closures != nullptr)
    for (const auto& x : closures->closures)
      vary_closure(c, s, x, path, r.forces_by_q, [&](vector_of by, int row, int dof, double, double acceleration) {
        r.equations(by)(row, dof) += closures->scale(x, row - x.first) * acceleration;
      });
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    auto& x = contacts[i];
    const auto& at = places.closures[static_cast<std::size_t>(x.closure)];
    const auto& element = runtime_elements{c}.element(at.element);
    path.find(s, at);
    for (const vector_of by : {vector_of::q, vector_of::v})
      for (int first = 0; first < path.size(); first += D::variables) {
        const auto put = [&](auto&& row, const D& value) {
          path.each_lane(first, [&](std::size_t lane, int dof) { row[dof] += value.derivative[lane]; });
        };
        const auto m = path.motion_along(by, first);
        const auto found = element.touch_at(m);
        x.slip_rate = values_of(found.slip_rate);
        x.each_equation(found, [&](int row, const D& value) { put(r.equations(by).row(x.first + row), value); });
        const vec3<D> force = x.force_at(found);
        auto& of_force = r.contact_forces[i][by == vector_of::q ? 0 : 1];
        put(of_force.row(0), force.x), put(of_force.row(1), force.y), put(of_force.row(2), force.z);
        path.subtract_forces(by, first, wrench_at_contact(m, force, found.point),
                             by == vector_of::q ? r.forces_by_q : r.forces_by_v);
      }
  }
  return r;
}
/// At the state after `contact_dynamics`; finds u' of the contacts. `closures`: the places of closures without
/// contacts, or null. `equations`: the number of all.
inline contact_variations vary_contacts(const runtime_chain& c, runtime_state& s, const closure_places* closures,
                                        const closure_places& places, std::vector<contact_in_mode>& contacts,
                                        int equations) {
  return is_known_by_elements(c, s) ? vary_contacts_along_paths(c, s, closures, places, contacts, equations)
                                    : vary_contacts_in_duals(c, s, closures, places, contacts, equations);
}

}  // namespace kte::detail
