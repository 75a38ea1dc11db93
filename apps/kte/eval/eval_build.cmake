# Writes eval_build.hpp, for programs that compile robots as types: compiler, options, and where headers are: those that
# are installed, seen from bin, or these.
include(GNUInstallDirs)
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH tools)
file(RELATIVE_PATH installed_library /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_INCLUDEDIR})
file(RELATIVE_PATH installed_headers /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_DATADIR}/kte)
set(flags)
foreach(library IN ITEMS Eigen3::Eigen Boost::headers)
  get_target_property(folders ${library} INTERFACE_INCLUDE_DIRECTORIES)
  list(FILTER folders EXCLUDE REGEX "^(/usr/include|.*-NOTFOUND)$")  # which must not come before the compiler's own
  list(TRANSFORM folders PREPEND -isystem)
  list(APPEND flags ${folders})
endforeach()
list(TRANSFORM flags REPLACE "(.+)" "R\"kte(\\1)kte\"")
string(JOIN ", " flags ${flags})
file(CONFIGURE OUTPUT eval_build.hpp @ONLY CONTENT [[
#pragma once

/// What this program was compiled with.
namespace evaluate {
inline constexpr const char* build_compiler = R"kte(@CMAKE_CXX_COMPILER@)kte";
inline constexpr const char* build_flags[] = {@flags@};
inline constexpr const char* source_library = R"kte(@PROJECT_SOURCE_DIR@/include)kte";
inline constexpr const char* source_headers = R"kte(@tools@)kte";
inline constexpr const char* installed_library = R"kte(@installed_library@)kte";
inline constexpr const char* installed_headers = R"kte(@installed_headers@)kte";
}  // namespace evaluate
]])
