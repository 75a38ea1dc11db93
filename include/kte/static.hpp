#pragma once

#include <kte/detail/macros_aside.hpp>

/// Static chains and the algorithms on them: no virtual calls and no heap, except for memory kept by chains of more
/// than KTE_UNROLLED_ELEMENTS elements. It compiles without exceptions and RTTI.
#include <kte/contract/checks.hpp>
#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/elements/all.hpp>
#include <kte/frames/inverse.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>
#include <kte/math/eigen.hpp>
#include <kte/math/quaternion.hpp>
#include <kte/static_chain/layout.hpp>
#include <kte/static_chain/static_chain.hpp>

#include <kte/detail/macros_back.hpp>
