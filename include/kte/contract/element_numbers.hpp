#pragma once

#include <kte/contract/joint.hpp>
#include <kte/contract/rigid_numbers.hpp>
#include <kte/detail/unroll.hpp>

/// An element in numbers, for the loops over body nodes (tree/body_node.hpp).
namespace kte::detail {

enum class part : unsigned char {
  base,      ///< declares an item
  rigid,     ///< a joint or link
  body,      ///< a rigid body on a frame, or the mass of a coordinate
  weight,    ///< a mass on a frame that is not part of a rigid body
  follower,  ///< writes a coordinate from others or from signals
  mover,     ///< writes a frame in another way
  signal,    ///< writes a signal
  closure,   ///< closes a loop, or is a contact; not part of the tree
  force      ///< all others: acts on the items at its ports; may have a mass on a coordinate
};

/// Whether an element has more than the properties that body nodes store.
template <class Core>
inline constexpr bool acts = !is_transmission<Core> && !is_closure<Core> && !is_contact<Core> && !is_rigid_body<Core> &&
                             Core::ports.back().how != access::base;

/// The number of inertial parameters of an element (`inertial_parameters` of dynamics/regressor.hpp).
template <class Core>
inline constexpr int parameter_count = Core::ports[0].what == kind::gen        ? has_mass<Core, double>
                                       : !is_rigid_body<Core>                  ? 0
                                       : Core::ports[0].what == kind::frame_2D ? 4
                                                                               : 10;

template <class P>
struct element_numbers {
  part is = part::force;
  bool plain_loads = true;  ///< for a joint or link: whether its loads follow from its `relative`
  bool power_dual = true;   ///< whether its loads are the power dual of its motion
  bool measures_accelerations = false;
  bool load_dependent_friction = false;  ///< for a joint: whether its friction depends on what it carries
  bool locks_coordinate = false;
  bool varying_axes = false;      ///< for a joint: contract/varying_joint.hpp
  bool distributed_mass = false;  ///< whether it has a mass between several ports
  bool has_energy = false;        ///< whether its core gives a kinetic or potential energy
  rigid_numbers<P> rigid{};
  rigid_body<P, vec3<P>, sym3<P>> body{};
  composite<P, vec3<P>, sym3<P>> weight{};
  P mass{0};              ///< on its coordinate
  bool has_mass = false;  ///< whether it has a mass there, which may be 0
};

/// A coordinate of kind K in plain numbers: zero, or the values at which (1), (2) of contract/rigid_numbers.hpp are
/// tested.
template <kind K>
constexpr auto plain_coordinate(bool tried) {
  if constexpr (K == kind::gen) {
    return tried ? coordinate<double, double, double, double, double>{tried_angle, 0, 0, tried_cosine, tried_sine}
                 : coordinate<double, double, double, double, double>{0, 0, 0, 1, 0};
  } else if constexpr (K == kind::pose_2D) {
    using in_plane = vec3<double, double, zero_t>;
    using about_z = vec3<zero_t, zero_t, double>;
    const rotation_2D<> r = tried ? rotation_2D<>{tried_cosine, tried_sine} : rotation_2D<>{1, 0};
    const in_plane p = tried ? in_plane{tried_position.x, tried_position.y, zero} : in_plane{};
    return motion{p, r, in_plane{}, about_z{}, in_plane{}, about_z{}};
  } else {
    const mat3<vec3<>> r = tried ? tried_rotation : as<double>(matrix(no_rotation{}));
    const vec3<> p = tried && K == kind::pose_3D ? tried_position : vec3<>{};
    return motion{p, r, vec3<>{}, vec3<>{}, vec3<>{}, vec3<>{}};
  }
}
/// The coordinates of a joint in plain numbers: `plain_coordinate` for each.
template <class Core>
constexpr auto plain_coordinates(bool tried) {
  if constexpr (coordinates_of<Core> == 1)
    return plain_coordinate<coordinate_kind<Core>>(tried);
  else
    return tuple_of_coordinates<Core>([tried]<std::size_t>() { return plain_coordinate<kind::gen>(tried); });
}
template <class P, class M>
pose<mat3<vec3<P>>, vec3<P>> plain_pose(const M& m) {
  return {as<P>(matrix(m.rotation)), as<P>(m.position)};
}
template <class P, class Core>
rigid_numbers<P> rigid_numbers_of(const Core& core) {
  rigid_numbers<P> x;
  if constexpr (coordinates_of<Core> == 0) {
    x.at_zero = plain_pose<P>(core.relative());
  } else {
    constexpr kind k = coordinate_kind<Core>;
    const auto at_zero = plain_coordinate<k>(false);
    x.at_zero = plain_pose<P>(core.relative(position_only(at_zero)));
    x.tried = plain_pose<P>(core.relative(position_only(plain_coordinate<k>(true))));
    unroll<joint_dofs<Core>>([&]<int N>() {
      const auto s = axis_of<N>(core, at_zero);
      x.linear[std::size_t{N}] = as<P>(s.velocity), x.angular[std::size_t{N}] = as<P>(s.ang_velocity);
    });
  }
  return x;
}

/// The numbers of an element in another precision.
template <class P>
element_numbers<P> as_numbers(const element_numbers<double>& n) {
  const auto placed = [](const auto& x) { return pose<mat3<vec3<P>>, vec3<P>>{as<P>(x.rotation), as<P>(x.position)}; };
  element_numbers<P> x;
  x.is = n.is, x.plain_loads = n.plain_loads, x.power_dual = n.power_dual,
  x.measures_accelerations = n.measures_accelerations;
  x.load_dependent_friction = n.load_dependent_friction, x.distributed_mass = n.distributed_mass;
  x.locks_coordinate = n.locks_coordinate, x.varying_axes = n.varying_axes, x.has_energy = n.has_energy;
  x.rigid.at_zero = placed(n.rigid.at_zero), x.rigid.tried = placed(n.rigid.tried);
  for (std::size_t k = 0; k < n.rigid.linear.size(); ++k)
    x.rigid.linear[k] = as<P>(n.rigid.linear[k]), x.rigid.angular[k] = as<P>(n.rigid.angular[k]);
  x.body = {static_cast<P>(n.body.mass), as<P>(n.body.com), as<P>(n.body.inertia)};
  x.weight = {static_cast<P>(n.weight.mass), as<P>(n.weight.moment), as<P>(n.weight.inertia)};
  x.mass = static_cast<P>(n.mass), x.has_mass = n.has_mass;
  return x;
}
template <class P, class Core>
element_numbers<P> numbers_of(const Core& core) {
  element_numbers<P> n;
  constexpr port last = Core::ports.back();
  n.load_dependent_friction = load_dependent_friction<Core>, n.distributed_mass = distributed_mass<Core>;
  n.locks_coordinate = locks_coordinate<Core>, n.power_dual = power_dual<Core>;
  if constexpr (is_closure<Core> || is_contact<Core>) {
    n.is = part::closure;
  } else if constexpr (is_transmission<Core>) {
    n.is = part::rigid;
    n.plain_loads = loads_by_relative<Core>;
    n.varying_axes = varying_axes<Core>;
    if constexpr (!varying_axes<Core>) n.rigid = rigid_numbers_of<P>(core);
  } else if constexpr (last.how == access::base) {
    n.is = part::base;
  } else if constexpr (last.how == access::out) {
    n.is = is_frame(last.what) ? part::mover : is_signal(last.what) ? part::signal : part::follower;
    n.measures_accelerations = reads_accelerations<Core>;
  } else if constexpr (has_mass<Core, P>) {
    const auto m = core.template mass<P>();
    if constexpr (!is_frame(Core::ports[0].what)) {
      n.mass = as<P>(m), n.has_mass = true;
      if (is_rigid_body<Core>) n.is = part::body;
    } else {
      n.is = is_rigid_body<Core> ? part::body : part::weight;
      n.weight = {as<P>(m.mass), as<P>(m.moment), as<P>(m.inertia)};
      if constexpr (is_rigid_body<Core>)
        n.body = {as<P>(core.body.mass), as<P>(core.body.com), as<P>(core.body.inertia)};
    }
  }
  return n;
}

}  // namespace kte::detail
