# packages.cmake - Debian packages, by CPack: `cmake --build BUILD --target package`, or `cpack` in BUILD.
#
#     isoroll          the command, its manual and completions, documents, examples
#     isoroll-mpi      sweeps on the ranks of MPI, if it was built
#     libisoroll0      the shared library
#     libisoroll-dev   headers, the static library, files for CMake and pkg-config
#     python3-isoroll  apps/python, for the Python of Debian
#
# The names are those of the components of installation in ../../CMakeLists.txt. finish.cmake adds what only packages
# have. With -DCMAKE_INSTALL_PREFIX=/usr the libraries go where Debian has them (/usr/lib/x86_64-linux-gnu), with any
# other prefix to /usr/lib.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME isoroll)
set(CPACK_PACKAGE_VENDOR "The isoroll authors")
set(CPACK_PACKAGE_CONTACT "The isoroll authors <authors@isoroll.example>" CACHE STRING
  "Maintainer of the Debian packages: Name <address>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish.cmake)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/date.cmake)
set(CPACK_ISO_SOURCE ${PROJECT_SOURCE_DIR}) # for finish.cmake

# package(NAME SECTION SUMMARY DESCRIPTION)
set(CPACK_COMPONENTS_ALL manual)
macro(package name section summary description)
  string(TOUPPER ${name} NAME)
  list(APPEND CPACK_COMPONENTS_ALL ${name})
  set(CPACK_DEBIAN_${NAME}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${NAME}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${NAME}_DESCRIPTION "${summary}\n${description}")
endmacro()
set(words "A ball covered with rubber rolls on a sphere: it neither slips nor twists.
A point moves on a sphere in a potential. For the right potential the two
have the same orbits. isoroll computes either motion, carries it to the
other, and shows both side by side.")
package(isoroll science "rubber ball rolling on a sphere, and its twin, a point" "${words}\n\
 This package has the command.")
package(libisoroll0 libs "rubber ball rolling on a sphere - library" "${words}\n This package has the shared library.")
package(libisoroll-dev libdevel "rubber ball rolling on a sphere - development" "${words}\n\
 This package has what programs in C are compiled with.")
package(python3-isoroll python "rubber ball rolling on a sphere - Python 3" "${words}\n\
 This package has isoroll for Python and NumPy.")
install(DIRECTORY apps/python/isoroll DESTINATION lib/python3/dist-packages COMPONENT python3-isoroll
        FILES_MATCHING PATTERN *.py PATTERN py.typed PATTERN __pycache__ EXCLUDE)
if(MPI_C_FOUND)
  package(isoroll-mpi science "rubber ball rolling on a sphere - sweeps by MPI" "${words}\n\
 This package has isoroll-mpi, for sweeps on many machines.")
endif()
set(CPACK_COMPONENT_MANUAL_GROUP isoroll)
set(CPACK_COMPONENT_ISOROLL_GROUP isoroll)

set(same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_ISOROLL_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot") # pictures
set(CPACK_DEBIAN_ISOROLL-MPI_PACKAGE_RECOMMENDS "openmpi-bin") # mpirun
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_LIBISOROLL0_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/triggers) # ldconfig
set(CPACK_DEBIAN_LIBISOROLL-DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON3-ISOROLL_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON3-ISOROLL_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON3-ISOROLL_PACKAGE_DEPENDS "libisoroll0 ${same}, python3, python3-numpy")
set(CPACK_DEBIAN_PYTHON3-ISOROLL_PACKAGE_RECOMMENDS python3-matplotlib) # the example
set(CPACK_DEBIAN_PYTHON3-ISOROLL_PACKAGE_CONTROL_EXTRA # compile the modules, and remove what was compiled
  "${CMAKE_CURRENT_LIST_DIR}/python3/postinst;${CMAKE_CURRENT_LIST_DIR}/python3/prerm")
# pkg-config reads gsl.pc and yaml-0.1.pc to tell the flags of compilation; static programs are linked with all of them
set(CPACK_DEBIAN_LIBISOROLL-DEV_PACKAGE_DEPENDS "libisoroll0 ${same}, libgsl-dev, libyaml-dev")
if(ISO_HDF5_PC)
  string(APPEND CPACK_DEBIAN_LIBISOROLL-DEV_PACKAGE_DEPENDS ", libhdf5-dev")
endif()
set(CPACK_DEBIAN_LIBISOROLL-DEV_PACKAGE_SUGGESTS "libsundials-dev") # only static programs are linked with it

include(CPack)
