# What isoroll is linked with: read when it is built, and by programs that link it statically (isorollConfig.cmake).

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
find_package(GSL REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(isoroll_yaml REQUIRED IMPORTED_TARGET yaml-0.1)

# The serial vector and the dense matrix and solver are part of the cvode and arkode libraries.
set(ISO_DEPENDENCIES SUNDIALS::cvode SUNDIALS::arkode GSL::gsl PkgConfig::isoroll_yaml Threads::Threads m)
set(ISO_SUNDIALS_LIBS "-lsundials_cvode -lsundials_arkode") # the same for isoroll.pc: SUNDIALS has no .pc file
if(TARGET SUNDIALS::core) # 7.x
  list(PREPEND ISO_DEPENDENCIES SUNDIALS::core)
  string(APPEND ISO_SUNDIALS_LIBS " -lsundials_core")
endif()
