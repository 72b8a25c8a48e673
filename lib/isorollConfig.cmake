# find_package(isoroll)                     gives isoroll::isoroll, the shared library
# find_package(isoroll COMPONENTS static)   gives isoroll::isoroll_static too, and then needs what isoroll is built on
include("${CMAKE_CURRENT_LIST_DIR}/isorollTargets.cmake")
foreach(component IN LISTS isoroll_FIND_COMPONENTS)
  if(component STREQUAL "static")
    include("${CMAKE_CURRENT_LIST_DIR}/isorollDependencies.cmake")
    include("${CMAKE_CURRENT_LIST_DIR}/isorollStaticTargets.cmake")
  elseif(isoroll_FIND_REQUIRED_${component})
    set(isoroll_FOUND FALSE)
    set(isoroll_NOT_FOUND_MESSAGE "isoroll has no component '${component}', only 'static'")
  endif()
endforeach()
