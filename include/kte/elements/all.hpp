// No `#pragma once`: this list is read once for the headers, then once for each use of KTE_ELEMENT.

/// The list of the elements of this library: the header of each, and its core types in runtime chains and files, with
/// parameters of plain numbers, and axes x, y, z typed. If several types share a name, a record becomes the first that
/// it fits. Registry, precompiled elements, `kte/static.hpp` and docs/elements.md follow this list. It has four parts,
/// each a source of kte::compiled (src/compiled).
#include <kte/elements/list/closures.hpp>
#include <kte/elements/list/controls.hpp>
#include <kte/elements/list/forces.hpp>
#include <kte/elements/list/joints.hpp>

#undef KTE_ELEMENT
