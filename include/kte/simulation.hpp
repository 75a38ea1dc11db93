#pragma once

#include <kte/detail/macros_aside.hpp>

/// Simulation: chains as systems, integrators, events. Each header can be included alone, which compiles faster.
#include <kte/events/events.hpp>
#include <kte/integrators/adams.hpp>
#include <kte/integrators/adams_BM.hpp>
#include <kte/integrators/bdf.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/implicit_midpoint.hpp>
#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>
#include <kte/integrators/semi_implicit_euler.hpp>
#include <kte/integrators/solution.hpp>
#include <kte/integrators/stormer_verlet.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>
#include <kte/models/controlled.hpp>
#include <kte/models/element_events.hpp>
#include <kte/models/inverse_dynamics_model.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/models/manipulator_kinematics_model.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/runtime_models.hpp>
#include <kte/models/variational.hpp>
#include <kte/models/vector_form.hpp>

#include <kte/detail/macros_back.hpp>
