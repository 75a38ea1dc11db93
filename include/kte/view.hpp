#pragma once

#include <kte/detail/macros_aside.hpp>

/// Pictures of mechanisms: scenes, recordings, SVG, and animated pages (needs the library kte::view; docs/view.md,
/// docs/pictures.md).
#include <kte/view/pictures.hpp>
#include <kte/view/write_mcap.hpp>
#include <kte/view/write_page.hpp>

#include <kte/detail/macros_back.hpp>
