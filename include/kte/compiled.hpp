#pragma once

/// Compiles the runtime chains that are `extern` with KTE_COMPILED (kte/detail/compiled.hpp). Include it in one source
/// file, first, unless the program links the CMake target kte::compiled.
#if defined(KTE_EXTERN) || defined(KTE_FUNCTION)
#  error "kte: include kte/compiled.hpp before other headers of kte"
#endif
#define KTE_COMPILED_HERE

#include <kte/control/discretize.hpp>
#include <kte/control/linearize_loops.hpp>
#include <kte/control/lqr.hpp>
#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/centroidal.hpp>
#include <kte/dynamics/closed_loops/statics.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/contacts/contact_derivatives.hpp>
#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/contacts/contact_jacobian.hpp>
#include <kte/dynamics/contacts/impact.hpp>
#include <kte/dynamics/contacts/impact_derivatives.hpp>
#include <kte/dynamics/contacts/operational_inertia.hpp>
#include <kte/dynamics/contacts/support_polygon.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/energy.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/lanes.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/elements/registry.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/io/recording.hpp>
#include <kte/io/table_writer.hpp>
#include <kte/loops.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>
#include <kte/models/detail/runtime_rate_derivatives.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/saltation_matrix.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/detail/mesh_file.hpp>
#include <kte/robots/detail/mesh_fit.hpp>
#include <kte/robots/detail/read_any.hpp>
#include <kte/robots/detail/xml_text.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/robots/urdf_writer.hpp>
#include <kte/statics.hpp>
