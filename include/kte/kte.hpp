#pragma once

#include <kte/detail/macros_aside.hpp>

/// Most programs need this header only: static and runtime chains, all elements except linkages and custom functions,
/// and
///
///   algorithms   inverse and forward dynamics, mass matrix, gravity and Coriolis forces, forward kinematics, motion
///                and Jacobians of frames, energies, centre of mass, centroidal momentum
///   integrators  euler, midpoint, runge_kutta4, runge_kutta5, dormand_prince45
///
/// Parts that take longer to compile, or are needed less often, are in further headers:
///
///   kte/dynamics.hpp                   all algorithms: also derivatives, M^-1, hybrid dynamics, momenta, the regressor
///   kte/dynamics/batch.hpp             many states at once, in packs
///   kte/static_chain/lanes.hpp         static chains with other parameters in each lane of packs, or in other scalars
///   kte/sweep.hpp                      a function on many cases, in packs, threads and processes
///   kte/statics.hpp                    equilibria under loads, their paths, natural modes
///   kte/simulation.hpp                 chains as systems x' = f(t, x), all integrators, events
///   kte/control.hpp                    linear systems of models, LQR, Riccati equations
///   kte/io.hpp                         files: models, tables, recorders, progress
///   kte/robots.hpp                     robots from URDF, MJCF, SDF, and to URDF and MJCF
///   kte/view.hpp                       pages that show mechanisms moving (links kte::view)
///   kte/manipulators.hpp               arms with limits: inverse kinematics, motions
///   kte/elements/four_bar.hpp          linkages; also dyad.hpp, slider_crank.hpp; law_follower.hpp, law_signal.hpp,
///                                      implicit_follower.hpp
///   kte/elements/registry.hpp          runtime chains from records (plain data)
///   kte/runtime_chain/from_record.hpp  static chains from records
///   kte/shared_coordinates.hpp         forward dynamics of runtime chains whose joints share coordinates
///   kte/adapters/sundials.hpp          solvers of SUNDIALS
///   kte/adapters/odeint.hpp            chains for Boost.Numeric.Odeint
///   kte/testing/element_laws.hpp       tests for custom elements
///   kte/static.hpp                     the static half of this header, without exceptions and RTTI
// Included first, so that little stands above the sentences that they have for the compiler.
// clang-format off
#include <kte/contract/checks.hpp>
#include <kte/contract/core_checks.hpp>
#include <kte/contract/gravity.hpp>
#include <kte/static_chain/state.hpp>
#include <kte/contract/transmission.hpp>
#include <kte/detail/raise.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
// clang-format on
#include <kte/static.hpp>

#ifdef KTE_COMPILED
#  include <kte/elements/compiled_elements.hpp>
#endif

#include <kte/detail/macros_back.hpp>
