# kte_add_robot(target robot.urdf|model.json|model.xml [NAME name]): the robot as a type. Writes the header `name.hpp`
# (the name of the file unless told) when the target is built, by the program kte-header, which is built once, and puts
# its folder on the target's include path: `#include "name.hpp"`, then `robots::name`. An installed kte has kte-header in
# its bin/, which is taken if it is there.
# Beside this file where kte is installed.
find_file(KTE_HEADER_SOURCE kte_header.cpp PATHS ${CMAKE_CURRENT_LIST_DIR} ${CMAKE_CURRENT_LIST_DIR}/../apps/kte_header NO_DEFAULT_PATH NO_CACHE)
set(KTE_HEADER_SOURCE ${KTE_HEADER_SOURCE} CACHE INTERNAL "")

function(kte_add_header_program)
  if(TARGET kte_header)
    return()
  endif()
  if(CMAKE_CROSSCOMPILING)  # it runs here
    find_program(KTE_HEADER kte-header REQUIRED)
  elseif(KTE_INSTALLED_BIN)
    find_program(KTE_HEADER kte-header PATHS ${KTE_INSTALLED_BIN} NO_CACHE NO_DEFAULT_PATH)
  endif()
  if(KTE_HEADER)
    add_executable(kte_header IMPORTED GLOBAL)
    set_target_properties(kte_header PROPERTIES IMPORTED_LOCATION ${KTE_HEADER})
    return()
  endif()
  if(NOT TARGET kte::robots)
    message(FATAL_ERROR "kte: kte_add_robot needs kte::robots, which needs tinyxml2")
  endif()
  add_executable(kte_header EXCLUDE_FROM_ALL ${KTE_HEADER_SOURCE})
  set_target_properties(kte_header PROPERTIES OUTPUT_NAME kte-header
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/kte-header)
  target_link_libraries(kte_header PRIVATE kte::robots)
  if(TARGET kte::compiled AND (KTE_BUILD_COMPILED OR KTE_BUILD_TESTS OR kte_compiled_FOUND))  # a tenth to compile
    target_link_libraries(kte_header PRIVATE kte::compiled)
  endif()
  target_compile_options(kte_header PRIVATE -O0)  # compiled faster than it ever runs
  target_compile_definitions(kte_header PRIVATE KTE_NO_FORCED_INLINE)
endfunction()

function(kte_add_robot target robot)
  cmake_parse_arguments(PARSE_ARGV 2 robot "" "NAME" "")
  if(robot_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "kte: kte_add_robot(target file [NAME name]) got '${robot_UNPARSED_ARGUMENTS}'")
  endif()
  cmake_path(ABSOLUTE_PATH robot OUTPUT_VARIABLE file)
  if(NOT robot_NAME)
    cmake_path(GET file STEM robot_NAME)
  endif()
  kte_add_header_program()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_robots)
  set(header ${folder}/${robot_NAME}.hpp)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${header} COMMAND kte_header ${file} -o ${header} --name ${robot_NAME}
    DEPENDS kte_header ${file} COMMENT "${robot_NAME}.hpp from ${robot}" VERBATIM)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL INTERFACE_LIBRARY)
    set(scope INTERFACE)
  else()
    set(scope PRIVATE)
  endif()
  target_sources(${target} ${scope} ${header})
  target_include_directories(${target} ${scope} ${folder})
endfunction()
