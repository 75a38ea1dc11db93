// No `#pragma once`: read once for each use of KTE_ELEMENT.

/// Measures, controls, actuators and motors. Part of the list kte/elements/all.hpp.
#ifndef KTE_ELEMENT
#  define KTE_ELEMENT(...)
#endif

// clang-format off
#include <kte/elements/acceleration_measure.hpp>
KTE_ELEMENT(acceleration_measure<kind::frame_2D>)
KTE_ELEMENT(acceleration_measure<kind::frame_3D>)
#include <kte/elements/ang_velocity_control.hpp>
KTE_ELEMENT(ang_velocity_control_2D)
KTE_ELEMENT(ang_velocity_control_3D)
#include <kte/elements/ang_velocity_measure.hpp>
KTE_ELEMENT(ang_velocity_measure_2D)
KTE_ELEMENT(ang_velocity_measure_3D)
#include <kte/elements/dc_motor.hpp>
KTE_ELEMENT(dc_motor_gen)
#include <kte/elements/driving_actuator.hpp>
KTE_ELEMENT(driving_actuator_gen)
KTE_ELEMENT(driving_actuator<kind::frame_2D>)
KTE_ELEMENT(driving_actuator<kind::frame_3D>)
#include <kte/elements/external_force.hpp>
KTE_ELEMENT(external_force<kind::frame_2D>)
KTE_ELEMENT(external_force<kind::frame_3D>)
#include <kte/elements/force_actuator.hpp>
KTE_ELEMENT(force_actuator_gen)
KTE_ELEMENT(force_actuator<kind::frame_2D>)
KTE_ELEMENT(force_actuator<kind::frame_3D>)
#include <kte/elements/joint_motor.hpp>
KTE_ELEMENT(joint_motor_gen)
#include <kte/elements/pid_control.hpp>
KTE_ELEMENT(pid_control_gen)
#include <kte/elements/position_control.hpp>
KTE_ELEMENT(position_control_gen)
KTE_ELEMENT(position_control<kind::frame_2D>)
KTE_ELEMENT(position_control<kind::frame_3D>)
#include <kte/elements/position_measure.hpp>
KTE_ELEMENT(position_measure_gen)
KTE_ELEMENT(position_measure<kind::frame_2D>)
KTE_ELEMENT(position_measure<kind::frame_3D>)
#include <kte/elements/rotation_control.hpp>
KTE_ELEMENT(rotation_control_2D)
KTE_ELEMENT(rotation_control_3D)
#include <kte/elements/rotation_measure.hpp>
KTE_ELEMENT(rotation_measure_2D)
KTE_ELEMENT(rotation_measure_3D)
#include <kte/elements/torque_speed_motor.hpp>
KTE_ELEMENT(torque_speed_motor_gen)
#include <kte/elements/velocity_control.hpp>
KTE_ELEMENT(velocity_control_gen)
KTE_ELEMENT(velocity_control_2D)
KTE_ELEMENT(velocity_control_3D)
#include <kte/elements/velocity_measure.hpp>
KTE_ELEMENT(velocity_measure_gen)
KTE_ELEMENT(velocity_measure<kind::frame_2D>)
KTE_ELEMENT(velocity_measure<kind::frame_3D>)
// clang-format on
