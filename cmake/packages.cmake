# Debian packages of what is installed, by `cpack --config CPackConfig.cmake` in the folder of the build: libkte-dev
# (headers, libraries, CMake package), kte (the program) and python3-kte, those that are built.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the authors of kte")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL)

# debian_package(component name section description; DEPENDS, SUGGESTS: lists of Debian)
function(debian_package component name section description)
  cmake_parse_arguments(PARSE_ARGV 4 its "" "DEPENDS;SUGGESTS" "")
  string(TOUPPER ${component} key)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION ${description} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_FILE_NAME DEB-DEFAULT PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS ON PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${its_DEPENDS}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SUGGESTS "${its_SUGGESTS}" PARENT_SCOPE)
endfunction()

if(KTE_INSTALL)
  debian_package(dev libkte-dev libdevel "Multibody dynamics in C++20: headers and libraries"
    DEPENDS "libeigen3-dev, libboost-dev"
    SUGGESTS "libcereal-dev, libtinyxml2-dev, libcpp-httplib-dev, libxsimd-dev, libsundials-dev")
endif()
if(KTE_INSTALL AND TARGET kte_program)
  debian_package(program kte science "Inspects, simulates, shows and converts robots and mechanisms"
    SUGGESTS "libkte-dev, g++")  # `kte eval --static` compiles
endif()
if(KTE_BUILD_PYTHON)
  debian_package(python python3-kte python "Multibody dynamics of mechanisms and robots in Python"
    DEPENDS "python3 (>= ${kte_python_version}), python3-numpy"
    SUGGESTS "g++, libeigen3-dev, libboost-dev, python3-pandas, python3-distributed")  # g++ and headers are of kte.compile
endif()
include(CPack)
