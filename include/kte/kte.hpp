#pragma once

/// All of kte but files: static chains, runtime chains, dynamics, integrators. Files need `kte/io.hpp`.
#include <kte/chain/checks.hpp>
#include <kte/dynamics/runtime.hpp>
#include <kte/dynamics/runtime_bodies.hpp>
#include <kte/static.hpp>
