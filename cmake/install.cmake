# Installs what CMakeLists.txt lists in `components`, the CMake package and the files of pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/kte)  # share, not lib: nothing in it depends on the machine

# An export for each component, so that who lacks a library can use the rest. Headers can be installed where nothing is
# built.
function(install_component target)
  install(TARGETS ${target} EXPORT ${target} ARCHIVE OPTIONAL FILE_SET HEADERS)
  install(EXPORT ${target} NAMESPACE kte:: DESTINATION ${package_dir})
endfunction()
set(installed ${components})
if(NOT KTE_BUILD_COMPILED)
  list(REMOVE_ITEM installed kte_compiled)
endif()
if(NOT KTE_BUILD_VIEW)
  list(REMOVE_ITEM installed kte_view kte_live)
endif()
foreach(target IN LISTS installed)
  install_component(${target})
endforeach()

file(RELATIVE_PATH to_bin /${package_dir} /${CMAKE_INSTALL_BINDIR})
file(RELATIVE_PATH to_lib /${package_dir} /${CMAKE_INSTALL_LIBDIR})
configure_file(cmake/kteConfig.cmake.in kteConfig.cmake @ONLY)
write_basic_package_version_file(kteConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/kteConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/kteConfigVersion.cmake
  cmake/kte_add_robot.cmake apps/kte_header/kte_header.cpp apps/kte_header/files_of_robot.hpp
  apps/kte_header/header_of_file.hpp DESTINATION ${package_dir})
install(FILES share/gdb/kte.py DESTINATION ${CMAKE_INSTALL_DATADIR}/gdb)
if(kte_view IN_LIST installed)
  install(FILES share/kte/page.licences.txt DESTINATION ${CMAKE_INSTALL_DATADIR}/kte)
endif()

if(PROJECT_IS_TOP_LEVEL AND TARGET kte_robots AND NOT CMAKE_CROSSCOMPILING)
  kte_add_header_program()
  set_target_properties(kte_header PROPERTIES EXCLUDE_FROM_ALL OFF INSTALL_RPATH_USE_LINK_PATH ON)
  install(TARGETS kte_header OPTIONAL)
endif()

# NAME.pc, found from where the file lies, so that the installed tree can be moved.
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_DATADIR}/pkgconfig /)
function(install_pkg_config name description requires cflags libs)
  file(CONFIGURE OUTPUT ${name}.pc @ONLY CONTENT [[
prefix=${pcfiledir}/@to_prefix@
libdir=${prefix}/@CMAKE_INSTALL_LIBDIR@
Name: @name@
Description: @description@
Version: @PROJECT_VERSION@
Requires: @requires@
Cflags: @cflags@
Libs: @libs@
]])
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
endfunction()
install_pkg_config(kte "${PROJECT_DESCRIPTION}" eigen3 "-I\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}" "")
if(kte_compiled IN_LIST installed)
  string(JOIN " " options -DKTE_COMPILED ${KTE_COMPILED_OPTIONS})
  install_pkg_config(kte-compiled "kte with runtime chains compiled" kte "${options}" "-L\${libdir} -lkte")
endif()
if(kte_view IN_LIST installed)
  install_pkg_config(kte-view "pages that show mechanisms of kte" kte "" "-L\${libdir} -lkte_view")
endif()
if(kte_live IN_LIST installed)
  install_pkg_config(kte-live "pages of running simulations of kte" kte-view "" "-L\${libdir} -lkte_live -lcpp-httplib -pthread")
endif()
