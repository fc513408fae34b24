# `cpack -G DEB` in the build folder makes three packages: wormdrive, python3-wormdrive and libwormdrive-dev. What they
# depend on follows from the libraries that their programs link (dpkg-shlibdeps).
set(WORMDRIVE_MAINTAINER "The wormdrive authors <wormdrive@example.org>" CACHE STRING "whom Debian's packages name")
set(DEB ${CMAKE_CURRENT_LIST_DIR})
set(BUILT ${CMAKE_CURRENT_BINARY_DIR}/debian)
string(TIMESTAMP DEB_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH sets it
file(READ ${CMAKE_SOURCE_DIR}/LICENSE DEB_LICENSE)
file(READ ${DYGRAPHS_NOTICE} DEB_DYGRAPHS)
configure_file(${DEB}/copyright.in ${BUILT}/copyright @ONLY)
configure_file(${DEB}/changelog.in ${BUILT}/changelog.Debian @ONLY)
configure_file(${CMAKE_SOURCE_DIR}/CHANGELOG.md ${BUILT}/changelog COPYONLY)
execute_process(COMMAND gzip -9nf ${BUILT}/changelog.Debian ${BUILT}/changelog COMMAND_ERROR_IS_FATAL ANY)

set(DEB_PACKAGES wormdrive libwormdrive-dev)
set(COMPONENTS_wormdrive program documentation)
set(COMPONENTS_libwormdrive-dev development)
if(WORMDRIVE_BINDINGS_PYTHON)
  list(APPEND DEB_PACKAGES python3-wormdrive)
  set(COMPONENTS_python3-wormdrive debian_python)
  # in Debian's place, which only a package may use; `cmake --install` puts the module where WORMDRIVE_PYTHON_DIR says
  set(DIST_PACKAGES lib/python3/dist-packages/wormdrive)
  install(TARGETS wormdrive_python LIBRARY DESTINATION ${DIST_PACKAGES} COMPONENT debian_python EXCLUDE_FROM_ALL)
  install(FILES ${WORMDRIVE_PYTHON_FILES} DESTINATION ${DIST_PACKAGES} COMPONENT debian_python EXCLUDE_FROM_ALL)
endif()

set(CPACK_COMPONENTS_ALL "")
foreach(package ${DEB_PACKAGES})
  install(FILES ${BUILT}/copyright ${BUILT}/changelog.Debian.gz ${BUILT}/changelog.gz
          DESTINATION share/doc/${package} COMPONENT doc_${package} EXCLUDE_FROM_ALL)
  foreach(component ${COMPONENTS_${package}} doc_${package})
    list(APPEND CPACK_COMPONENTS_ALL ${component})
    string(TOUPPER ${component} upper)
    set(CPACK_COMPONENT_${upper}_GROUP ${package})
  endforeach()
  string(TOUPPER ${package} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${DEB}/strip_archives.cmake)
set(CPACK_PACKAGE_CONTACT ${WORMDRIVE_MAINTAINER})
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0.1)  # not one of Debian's own, which begin with 1
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(long "Self-locking, stick, break-in and the change of the tooth flank that carries
the load are events of a hybrid system, located to the accuracy of the solver.
Uncertain parameters are swept over any number of drives, and measured data
are diagnosed: which effects a scenario lacks.")
set(CPACK_DEBIAN_WORMDRIVE_DESCRIPTION "simulator of worm-gear drives
${long}")
set(CPACK_DEBIAN_WORMDRIVE_PACKAGE_SECTION science)
set(CPACK_DEBIAN_WORMDRIVE_PACKAGE_SHLIBDEPS ON)
# to draw; everything else works without
set(CPACK_DEBIAN_WORMDRIVE_PACKAGE_RECOMMENDS "python3, python3-h5py, python3-matplotlib, python3-numpy")
set(CPACK_DEBIAN_WORMDRIVE_PACKAGE_SUGGESTS "openmpi-bin, python3-wormdrive, libwormdrive-dev")

set(CPACK_DEBIAN_LIBWORMDRIVE-DEV_DESCRIPTION "simulator of worm-gear drives (C++ libraries and headers)
${long}

This package has the libraries, their headers and the package for CMake.")
set(CPACK_DEBIAN_LIBWORMDRIVE-DEV_PACKAGE_SECTION libdevel)
set(dev libboost-dev libceres-dev libeigen3-dev libfmt-dev libhdf5-dev libmatio-dev libnlopt-dev librandom123-dev libsundials-dev
        libtomlplusplus-dev nlohmann-json3-dev)
if(MPI_CXX_FOUND)
  list(APPEND dev libopenmpi-dev)
endif()
list(JOIN dev ", " CPACK_DEBIAN_LIBWORMDRIVE-DEV_PACKAGE_DEPENDS)

if(WORMDRIVE_BINDINGS_PYTHON)
  execute_process(COMMAND ${WORMDRIVE_PYTHON} -c "import sys; print(sys.version_info.minor)" OUTPUT_VARIABLE minor
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON3-WORMDRIVE_DESCRIPTION "simulator of worm-gear drives (Python module)
${long}

This package has the module for Python: runs as NumPy arrays.")
  set(CPACK_DEBIAN_PYTHON3-WORMDRIVE_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON3-WORMDRIVE_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON3-WORMDRIVE_PACKAGE_DEPENDS
      "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON3-WORMDRIVE_PACKAGE_SUGGESTS "python3-xarray")
  set(CPACK_DEBIAN_PYTHON3-WORMDRIVE_PACKAGE_CONTROL_EXTRA "${DEB}/postinst;${DEB}/prerm")
endif()
include(CPack)

# Without dpkg-shlibdeps CPack makes packages that depend on nothing, and says so in passing only.
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
set(NO_SHLIBDEPS "packages need dpkg-shlibdeps (Debian: dpkg-dev); install it and configure again")
# Outside the tests: needs root, and Debian's mmdebstrap and lintian.
add_custom_target(packages COMMAND sh -c "test -x '${DPKG_SHLIBDEPS}' || { echo '${NO_SHLIBDEPS}' >&2; exit 1; }"
                  COMMAND ${CMAKE_COMMAND} -E rm -rf ${CPACK_PACKAGE_DIRECTORY}
                  COMMAND ${CMAKE_CPACK_COMMAND} -G DEB WORKING_DIRECTORY ${CMAKE_BINARY_DIR}
                  VERBATIM DEPENDS wormdrive wormdrive_fmu manual ${LIBRARIES})
if(WORMDRIVE_BINDINGS_PYTHON)
  add_dependencies(packages wormdrive_python)
endif()
add_custom_target(check_packages COMMAND ${CMAKE_SOURCE_DIR}/tools/check_packages ${CMAKE_BINARY_DIR} VERBATIM)
add_dependencies(check_packages packages)
