# wheel.cmake - isoroll for pip.
#
#     cmake --build BUILD --target wheel    BUILD/wheel/isoroll-VERSION-py3-none-manylinux_2_N_x86_64.whl
#     cmake --build BUILD --target sdist    BUILD/wheel/isoroll-VERSION.tar.gz, the sources, from which pip makes it
#
# The wheel has the package of apps/python, the library and the command. Both have GSL, SUNDIALS and the others linked
# in, from static libraries, so they need glibc alone: 2.N or later. Arb is left out: `prove` and `run --certify`
# refuse. ../python/pack.py packs, and computes N.
set(wheel ${PROJECT_BINARY_DIR}/wheel)
set(pack ${ISO_PYTHON} ${PROJECT_SOURCE_DIR}/apps/python/pack.py)

set(missing)
set(archives)
set(names sundials_cvode sundials_arkode gsl gslcblas yaml)
if(TARGET SUNDIALS::core) # 7.x
  list(INSERT names 2 sundials_core)
endif()
if(ISO_HDF5_PC)
  list(APPEND names hdf5 sz aec z)
endif()
foreach(name IN LISTS names ITEMS jansson)
  find_library(ISO_ARCHIVE_${name} lib${name}.a HINTS ${isoroll_hdf5_LIBRARY_DIRS} DOC "static library, for wheels")
  mark_as_advanced(ISO_ARCHIVE_${name})
  if(NOT ISO_ARCHIVE_${name})
    list(APPEND missing lib${name}.a)
  elseif(NOT name STREQUAL jansson)
    list(APPEND archives ${ISO_ARCHIVE_${name}})
  endif()
endforeach()
if(NOT ISO_SUNDIALS) # a wheel has all methods
  list(APPEND missing "ISO_SUNDIALS=ON")
endif()
if(NOT ISO_STUB)
  list(APPEND missing "python3 with NumPy")
endif()
if(NOT CMAKE_SYSTEM_NAME STREQUAL Linux OR ISO_SANITIZE)
  list(APPEND missing "Linux without sanitizers")
endif()

set(ISO_WHEEL FALSE)
if(missing)
  list(JOIN missing ", " missing)
  add_custom_target(wheel COMMENT "A wheel cannot be made here. Missing: ${missing}" COMMAND ${CMAKE_COMMAND} -E false)
else()
  set(ISO_WHEEL TRUE)
  add_library(isoroll_wheel MODULE EXCLUDE_FROM_ALL apps/packaging/stand_in.c $<TARGET_OBJECTS:isoroll_objects>
    ${objects_without_arb})
  add_executable(isoroll_wheel_command EXCLUDE_FROM_ALL apps/packaging/stand_in.c $<TARGET_OBJECTS:isoroll_command>
    $<TARGET_OBJECTS:isoroll_commands> $<TARGET_OBJECTS:isoroll_objects> ${objects_without_arb})
  set_target_properties(isoroll_wheel PROPERTIES PREFIX "" OUTPUT_NAME libisoroll SUFFIX .so.0)
  set_target_properties(isoroll_wheel_command PROPERTIES OUTPUT_NAME isoroll)
  target_link_libraries(isoroll_wheel_command PRIVATE ${ISO_ARCHIVE_jansson})
  foreach(target isoroll_wheel isoroll_wheel_command)
    set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${wheel} RUNTIME_OUTPUT_DIRECTORY ${wheel})
    target_link_libraries(${target} PRIVATE ${archives} Threads::Threads m ${CMAKE_DL_LIBS})
    target_link_options(${target} PRIVATE -s -static-libgcc -static-libstdc++ -Wl,--exclude-libs,ALL -Wl,-z,defs
      -Wl,--wrap=hypot -Wl,--wrap=stderr,--wrap=stdout)
  endforeach()

  configure_file(apps/packaging/notices.in ${wheel}/NOTICES @ONLY)
  file(GLOB modules CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/apps/python/isoroll/*.py)
  add_custom_command(OUTPUT ${wheel}/packed VERBATIM
    COMMAND ${CMAKE_COMMAND} -E copy ${ISO_STUB} ${wheel}
    COMMAND ${pack} wheel ${wheel}
    COMMAND ${CMAKE_COMMAND} -E touch ${wheel}/packed
    DEPENDS isoroll_wheel isoroll_wheel_command ${modules} ${ISO_STUB} ${wheel}/NOTICES apps/packaging/date.cmake
      apps/python/pack.py apps/python/README.md LICENSE)
  add_custom_target(wheel DEPENDS ${wheel}/packed)
  add_dependencies(wheel python_stub)
endif()
add_custom_target(sdist COMMAND ${pack} sdist ${wheel} VERBATIM)
