#pragma once

/// Pictures of mechanisms: scenes, recordings for them, SVG, and pages that show them moving (needs the library
/// kte::view; docs/view.md, docs/pictures.md).
#include <kte/view/pictures.hpp>
#include <kte/view/write_mcap.hpp>
#include <kte/view/write_page.hpp>
