#pragma once

#include <kte/contract/things_at_ports.hpp>

#include <concepts>
#include <string_view>
#include <type_traits>

/// The contract of an element. Its core is a struct with parameters and arithmetic; the concepts state what each of its
/// functions takes and returns. Algorithms use these concepts and never test for a type.
/// `static_assert(kte::force_core<my_core>)` reports what a core lacks.
///
/// Functions take the items at the ports, in the order of the ports. The members of an item are numbers of any scalar
/// type, typed constants, or `skip` if an algorithm omits them:
///
///   kind of the port                 thing                                                       load
///   gen                              coordinate: q, q_dot, q_ddot, m or rad; cos, sin by `angle`  number, N or Nm
///   rotation_3D, pose_2D, pose_3D    motion, in the axes of frames/motion.hpp                    wrench
///   frame_2D, frame_3D               motion; in the plane with typed zeros                       wrench
///   input, internal                  number                                                      none
///   vector                           vec3                                                        none
///   loop                             loop_state                                                  none
///   contact                          contact_state                                               none
///
/// A load acts on the mechanism: the wrench on a frame at its origin, in its axes, N and Nm.
namespace kte {

struct parameter_check;
template <class Core>
struct transmission;
template <class Core>
struct coordinate_follower;
struct coordinate_lock;

/// Every core. `type` is its name in files and messages ("spring_2D"). `ports` are its connections; the port that it
/// writes is the last. `check` has the rules for its parameters: `where.positive(k, "k must be positive")`.
template <class Core>
concept element_core = requires(const Core& core, const parameter_check& where) {
  { Core::type } -> std::convertible_to<std::string_view>;
  { Core::ports[0] } -> std::convertible_to<port>;
  core.check(where);
};

/// A core that files can hold. `parameters(self, visit)` calls `visit("name", self.member)` for each parameter, in the
/// order of files. If `self` is not constant, values that depend on parameters must then be computed again. The core
/// has a default constructor, for parameters to be read into. Optional: `optional_parameters`, a std::array of the
/// names that files may omit, and `arguments`, the form of the parameters in the factory if they are not passed one by
/// one: "rest_length, {EA, EI, GA}".
template <class Core>
concept core_in_files = element_core<Core> && std::default_initializable<Core> &&
    requires(const Core& core, const detail::any_visitor& visit) {
  Core::parameters(core, visit);
};

// What a core declares: `static constexpr bool reads_positions = true;`

/// Its forces depend on positions, rotations or linear velocities of frames, which unrolled algorithms otherwise omit.
template <class Core>
concept reads_positions = requires {
  requires Core::reads_positions;
};
/// Its signal depends on accelerations; then no force may depend on the signal.
template <class Core>
concept reads_accelerations = requires {
  requires Core::reads_accelerations;
};
/// It has a mass on several ports, with `mass_loads`.
template <class Core>
concept distributed_mass = requires {
  requires Core::distributed_mass;
};
/// Its only loads are those of a rigid body, `core.body`, on its frame, or of the mass on its coordinate.
template <class Core>
concept is_rigid_body = requires {
  requires Core::is_rigid_body;
};
/// It is an external load on its first port, constant or given by signals; `static_equilibrium` applies it in
/// increments.
template <class Core>
concept is_load = requires {
  requires Core::is_load;
};
/// It is a joint with load-dependent friction: `friction(coordinate, wrench)`, with the wrench on its end in the axes
/// of the end, returns a load on the coordinate.
template <class Core>
concept load_dependent_friction = requires {
  requires Core::load_dependent_friction;
};
/// It may lock a coordinate, as `coordinate_lock` declares; `capacity(things...)` returns the largest holding force.
template <class Core>
concept locks_coordinate = requires {
  requires Core::locks_coordinate;
};
/// It is a joint whose axes, in the axes of the end, depend on its coordinates. By default true for joints of several
/// coordinates.
template <class Core>
concept varying_axes = requires {
  requires Core::varying_axes;
}
|| detail::has_several_coordinates<Core>;
/// Its loads are the power dual of its motion, as in a mechanism. An element for controllers declares `power_dual =
/// false`; only passes and inverse dynamics support it.
template <class Core>
concept power_dual = !requires {
  requires !Core::power_dual;
};
/// Its internal states follow from the position at the start of a motion: `switched` returns them.
template <class Core>
concept starts_in_place = requires {
  requires Core::starts_in_place;
};
/// It contains functions of the program, which files cannot hold.
template <class Core>
concept holds_code = requires {
  requires Core::holds_code;
};
/// Its passes may throw `bad_argument` or `dead_point`, for example for a loop that cannot be closed.
template <class Core>
concept may_have_no_value = requires {
  requires Core::may_have_no_value;
};

namespace detail {
template <class Core>
concept locks_by_load = load_dependent_friction<Core> && locks_coordinate<Core>;
}  // namespace detail

// Functions of a core, for things of given types.

/// `doForce(things...)` returns `make_loads(...)`: a load for each port that is not a signal, in order.
template <class Core, class... Things>
concept has_force = requires(const Core& core, const Things&... things) {
  { core.doForce(things...) } -> detail::loads_for<Core>;
};
/// `doMotion(things...)` returns the item that the element writes: a coordinate, the motion of a frame, or a signal.
template <class Core, class... Things>
concept has_motion = requires(const Core& core, const Things&... things) {
  core.doMotion(things...);
};
/// `relative(coordinates...)` of a joint, `relative()` of a link: the motion of its end in its base.
template <class Core, class... Coordinates>
concept has_relative = requires(const Core& core, const Coordinates&... c) {
  core.relative(c...).position;
  core.relative(c...).rotation;
};
/// `z_dot(things...)` returns the rate of the internal state, or `make_rates(...)` for several.
template <class Core, class... Things>
concept has_rate = requires(const Core& core, const Things&... things) {
  core.z_dot(things...);
};
/// `mass_loads(things...)` returns the loads due to accelerations only, linear in them; `doForce` includes them.
template <class Core, class... Things>
concept has_mass_loads = requires(const Core& core, const Things&... things) {
  { core.mass_loads(things...) } -> detail::loads_for<Core>;
};
/// `kinetic_energy(things...)`, J. Optional.
template <class Core, class... Things>
concept has_kinetic_energy = requires(const Core& core, const Things&... things) {
  core.kinetic_energy(things...);
};
/// `potential_energy(things...)`, J, without gravity. Optional.
template <class Core, class... Things>
concept has_potential_energy = requires(const Core& core, const Things&... things) {
  core.potential_energy(things...);
};
/// `first_moment(things...)` of a distributed mass: m c in world axes, kg m. Optional; without it gravity does not act.
template <class Core, class... Things>
concept has_first_moment = requires(const Core& core, const Things&... things) {
  core.first_moment(things...);
};
/// `switching(things...)` passes through zero where the law of the element changes. Optional.
template <class Core, class... Things>
concept has_switching = requires(const Core& core, const Things&... things) {
  core.switching(things...);
};
/// `switched(things...)` returns the internal states after an event of the element. Optional.
template <class Core, class... Things>
concept has_switched = requires(const Core& core, const Things&... things) {
  core.switched(things...);
};

namespace detail {
// Whether `doForce` fits the items at the ports of a core, in plain numbers.
template <class Core, class... T>
consteval bool force_fits(things_list<T...>) {
  return has_force<Core, T...>;
}
template <class Core, class... T>
consteval bool motion_fits(things_list<T...>) {
  return has_motion<Core, T...>;
}
template <class Core, class... T>
consteval bool relative_fits(things_list<T...>) {
  return has_relative<Core, T...>;
}
template <class Core, class... T>
consteval bool rate_fits(things_list<T...>) {
  return has_rate<Core, T...>;
}
template <class Core, class... T>
consteval bool mass_loads_fit(things_list<T...>) {
  return has_mass_loads<Core, T...>;
}
}  // namespace detail

// Shapes of elements.

/// A base: it declares a frame or coordinate that no element moves.
template <class Core>
concept base_core = element_core<Core> && Core::ports.back().how == access::base;
/// A force: spring, damper, motor. It writes nothing.
template <class Core>
concept force_core = element_core<Core> && !Core::ports.back().writes() && !detail::is_closure<Core> &&
                     !detail::is_contact<Core> && detail::force_fits<Core>(detail::things_read<Core>{});
/// A body: a force with `mass<S>()`, in numbers of type S, on its first port. On a coordinate it is a number, kg or kg
/// m^2; on a frame a `composite` about its origin, in its axes.
template <class Core>
concept body_core = force_core<Core> && requires(const Core& core) {
  core.template mass<double>();
};
/// A mass on several ports: a force that declares `distributed_mass`.
template <class Core>
concept distributed_mass_core = force_core<Core> && distributed_mass<Core> &&
    detail::mass_loads_fit<Core>(detail::things_read<Core>{});
/// A link: it derives from `transmission<Core>` (contract/transmission.hpp), and `relative()` is the motion of its end
/// in its base. Ports: base, end.
template <class Core>
concept link_core = element_core<Core> && std::is_base_of_v<transmission<Core>, Core> && detail::coordinates_of<Core>
== 0 && has_relative<Core>;
/// A joint: it derives from `transmission<Core>`, and `relative(coordinates...)` is the motion of its end in its base.
/// Ports: coordinates, base, end. Passes, mass matrix, articulated bodies and derivatives follow from `relative`.
template <class Core>
concept joint_core = element_core<Core> && std::is_base_of_v<transmission<Core>, Core> &&
                     (detail::coordinates_of<Core> > 0) &&
                     detail::relative_fits<Core>(detail::coordinates_at<Core>{});
/// A coordinate that follows others: `doMotion(things...)` returns a `coordinate`, and `doForce(things..., f)` the
/// loads for a force f on it. A core derived from `coordinate_follower<Core>` has `value(q_1, q_2, ...)` instead.
template <class Core>
concept coordinate_follower_core = element_core<Core> && detail::writes_coordinate<Core> &&
    detail::motion_fits<Core>(detail::things_read<Core>{}) && detail::force_fits<Core>(detail::things_and_load<Core>{});
/// A frame that follows frames and coordinates, and is not moved by a joint or link: `doMotion(things...)` returns its
/// motion, and `doForce(things..., wrench)` the loads dual to a wrench on it.
template <class Core>
concept frame_follower_core =
    element_core<Core> && detail::writes_frame<Core> && !std::is_base_of_v<transmission<Core>, Core> &&
    detail::motion_fits<Core>(detail::things_read<Core>{}) && detail::force_fits<Core>(detail::things_and_load<Core>{});
/// A prescribed motion: a coordinate or frame that follows signals only.
template <class Core>
concept prescribed_motion_core = (coordinate_follower_core<Core> ||
                                  frame_follower_core<Core>)&&is_signal(Core::ports[0].what) &&
                                 !detail::reads_coordinates<Core>;
/// A signal: sensor, controller. `doMotion(things...)` returns a number or a vector; there are no loads.
template <class Core>
concept signal_core = element_core<Core> && detail::writes_signal<Core> &&
    detail::motion_fits<Core>(detail::things_read<Core>{});
/// A core with internal states, ports of `access::keep`; it also has `z_dot`.
template <class Core>
concept stateful_core =
    element_core<Core> &&(detail::kept_count<Core> > 0) && detail::rate_fits<Core>(detail::things_read<Core>{});
/// A core that may lock a coordinate: it derives from `coordinate_lock` (contract/coordinate_lock.hpp).
template <class Core>
concept lock_core = stateful_core<Core> && locks_coordinate<Core> && std::is_base_of_v<coordinate_lock, Core>;
/// A closure of a kinematic loop: it derives from `closure<Core>` (contract/closure.hpp), with `residual`,
/// `residual_dot` and `residual_ddot`, or from `coordinate_closure<Core>`, with `value`. `rows`: the number of its
/// rows.
template <class Core>
concept closure_core = element_core<Core> && detail::is_closure<Core> &&(Core::rows.count() > 0);
/// A contact with friction between two frames: it derives from `contact<Core>` (contract/contact.hpp), with `gap`,
/// `normal`, `point`, `slip` and `slip_rate`.
template <class Core>
concept contact_core = element_core<Core> && detail::is_contact<Core> &&(Core::rows.count() > 0);

}  // namespace kte
