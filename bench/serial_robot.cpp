#include "serial_robot.hpp"

#include <boost/hana/for_each.hpp>

#include <cstdlib>

#include "models.hpp"

namespace bench {
namespace {

template <class X>
Eigen::Vector3d vector_of(const X& x) {
  const auto v = kte::as<double>(x);
  return {v.x, v.y, v.z};
}
/// Of whatever turns vectors: a matrix, a typed turn, nothing.
template <class R>
Eigen::Matrix3d matrix_of(const R& r) {
  Eigen::Matrix3d m;
  m << vector_of(r * kte::axis::x), vector_of(r * kte::axis::y), vector_of(r * kte::axis::z);
  return m;
}
template <class... T>
Eigen::Matrix3d matrix_of(const kte::sym3<T...>& x) {
  const auto i = kte::as<double>(x);
  Eigen::Matrix3d m;
  m << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz;
  return m;
}

/// The robot of a chain that consists of links, joints and bodies in turn, and a link to the tool.
template <class Chain>
serial_robot robot_of_chain(const Chain& chain) {
  serial_robot r{{}, vector_of(chain.gravity()), Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  boost::hana::for_each(chain.elements(), [&]<class Core, class... Keys>(const kte::element<Core, Keys...>& e) {
    if constexpr (requires { e.core.axis; }) {
      r.links.push_back({r.tool_rotation, r.tool_position, vector_of(e.core.axis), 0, {}, {}});
      r.tool_rotation.setIdentity(), r.tool_position.setZero();
    } else if constexpr (requires { e.core.body; }) {
      auto& l = r.links.back();
      l.mass = kte::as<double>(e.core.body.mass), l.inertia = matrix_of(e.core.body.inertia);
      l.com = r.tool_position + r.tool_rotation * vector_of(e.core.body.com);  // of the pendulum it is on the tool
    } else {
      r.tool_rotation = matrix_of(e.core.rotation), r.tool_position = vector_of(e.core.position);
    }
  });
  return r;
}

serial_robot serial_chain(int n) {
  serial_robot r{{}, {0, 0, -9.81}, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  for (int i = 0; i < n; ++i) {
    const auto& b = serial_body(i);
    r.links.push_back({matrix_of(b.rotation), vector_of(b.position), vector_of(b.axis), b.body.mass,
                       vector_of(b.body.com), matrix_of(b.body.inertia)});
  }
  return r;
}

}  // namespace

int serial_length(const std::string& model) {
  return model.rfind("serial", 0) == 0 ? std::atoi(model.c_str() + sizeof("serial") - 1) : 0;
}

serial_robot robot_of(const std::string& model) {
  if (model == pendulum::name) return robot_of_chain(pendulum::chain);
  if (model == iiwa14::name) return robot_of_chain(iiwa14::chain);
  if (model == ur5::name) return robot_of_chain(ur5::chain);
  return serial_chain(serial_length(model));
}

}  // namespace bench
