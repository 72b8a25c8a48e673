# What isoroll is linked with: read when it is built, and by programs that link it statically (isorollConfig.cmake).

# Programs are told by isorollConfig.cmake whether the library has SUNDIALS.
if(NOT DEFINED ISO_SUNDIALS)
  option(ISO_SUNDIALS "The methods cvode and arkode, which need SUNDIALS" ON)
endif()
set(ISO_SUNDIALS_TARGETS)
set(ISO_SUNDIALS_LIBS) # the same for isoroll.pc: SUNDIALS has no .pc file
if(ISO_SUNDIALS)
  # SUNDIALSConfig.cmake looks for OpenMP, which clang has only with libomp installed. isoroll uses the serial
  # vectors alone: an empty target answers the question.
  if(NOT TARGET OpenMP::OpenMP_C)
    add_library(OpenMP::OpenMP_C INTERFACE IMPORTED)
  endif()

  # SUNDIALS accepts a request for one major version only, and 6.x and 7.x both do: the version is compared here.
  find_package(SUNDIALS CONFIG REQUIRED COMPONENTS cvode arkode)
  if(SUNDIALS_VERSION VERSION_LESS 6.4.1)
    message(FATAL_ERROR "isoroll needs SUNDIALS 6.4.1 or later, found ${SUNDIALS_VERSION}")
  endif()
  # The serial vector and the dense matrix and solver are part of the cvode and arkode libraries.
  set(ISO_SUNDIALS_TARGETS SUNDIALS::cvode SUNDIALS::arkode)
  set(ISO_SUNDIALS_LIBS "-lsundials_cvode -lsundials_arkode")
  if(TARGET SUNDIALS::core) # 7.x
    list(PREPEND ISO_SUNDIALS_TARGETS SUNDIALS::core)
    string(APPEND ISO_SUNDIALS_LIBS " -lsundials_core")
  endif()
endif()
find_package(Threads REQUIRED)
if(NOT EMSCRIPTEN) # apps/live has compiled its own
  find_package(GSL REQUIRED)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(isoroll_yaml REQUIRED IMPORTED_TARGET yaml-0.1)
endif()

# HDF5 may be missing, or be the flavour that needs MPI: then there is none.
option(ISO_HDF5 "Trajectories in HDF5 (.h5), where its serial library is installed" ON)
if(ISO_HDF5)
  foreach(name hdf5-serial hdf5) # Debian's, and others'
    if(NOT TARGET PkgConfig::isoroll_hdf5)
      pkg_check_modules(isoroll_hdf5 QUIET IMPORTED_TARGET ${name})
      if(isoroll_hdf5_LINK_LIBRARIES MATCHES "mpi")
        set(isoroll_hdf5_FOUND FALSE)
      endif()
    endif()
  endforeach()
endif()

# The C++ library, for digits of numbers: who links with a C compiler must name it.
set(ISO_CXX_LIBS stdc++)
if(APPLE)
  set(ISO_CXX_LIBS c++)
elseif(EMSCRIPTEN) # there isoroll calls none of it
  set(ISO_CXX_LIBS)
endif()
list(TRANSFORM ISO_CXX_LIBS PREPEND -l OUTPUT_VARIABLE ISO_CXX_PC)
set(ISO_DEPENDENCIES ${ISO_SUNDIALS_TARGETS} GSL::gsl PkgConfig::isoroll_yaml Threads::Threads m ${ISO_CXX_LIBS})
if(ISO_HDF5 AND isoroll_hdf5_FOUND)
  set(ISO_HDF5_PC ${isoroll_hdf5_MODULE_NAME})
  list(APPEND ISO_DEPENDENCIES PkgConfig::isoroll_hdf5)
endif()

# Arb may be missing: then `isoroll prove` and `run --certify` refuse. It is a library of its own, or a part of FLINT 3.
option(ISO_ARB "isoroll prove and run --certify, where Arb is installed" ON)
if(ISO_ARB)
  find_path(ISO_ARB_INCLUDE NAMES arb.h flint/arb.h DOC "where arb.h is")
  find_library(ISO_FLINT flint DOC "FLINT")
  find_library(ISO_FLINT_ARB NAMES flint-arb arb DOC "Arb, where it is no part of FLINT 3")
  find_library(ISO_GMP gmp DOC "GMP, which FLINT's headers call")
  mark_as_advanced(ISO_ARB_INCLUDE ISO_FLINT ISO_FLINT_ARB ISO_GMP)
endif()
if(ISO_ARB AND ISO_ARB_INCLUDE AND ISO_FLINT AND ISO_GMP AND (ISO_FLINT_ARB OR EXISTS ${ISO_ARB_INCLUDE}/flint/arb.h))
  set(ISO_ARB_LIBS ${ISO_FLINT} ${ISO_GMP})
  if(ISO_FLINT_ARB AND NOT EXISTS ${ISO_ARB_INCLUDE}/flint/arb.h)
    list(PREPEND ISO_ARB_LIBS ${ISO_FLINT_ARB})
  endif()
  list(APPEND ISO_DEPENDENCIES ${ISO_ARB_LIBS})
  list(TRANSFORM ISO_ARB_LIBS REPLACE ".*/lib([^/]*)[.](so|a|dylib)[^/]*$" "-l\\1" OUTPUT_VARIABLE ISO_ARB_PC)
  list(JOIN ISO_ARB_PC " " ISO_ARB_PC)
endif()
