#pragma once

/// The version of kte, for `#if`. Versions follow semantic versioning; before 1.0 a minor version may break code.
#define KTE_VERSION_MAJOR 0
#define KTE_VERSION_MINOR 1
#define KTE_VERSION_PATCH 0
