#pragma once

/// All of kte but files: static chains, runtime chains, dynamics, integrators. Files need `kte/io.hpp`.
#include <kte/chain/from_record.hpp>
#include <kte/chain/registry.hpp>
#include <kte/dynamics/runtime.hpp>
#include <kte/static.hpp>
