#pragma once

#include "define.hpp"
#include "signal_watch.hpp"

/// Functions of one state.
namespace kte_python {

inline array xyz_array(const kte::vec3<>& v) { return to_array(Eigen::VectorXd(Eigen::Vector3d(v.x, v.y, v.z))); }

/// f(chain, state) without the GIL; Ctrl-C ends it.
template <class F>
auto compute(const chain_object& c, const F& f) {
  lease work(c);
  return run_interruptibly([&] { return f(c.chain(), work->state); });
}

}  // namespace kte_python
