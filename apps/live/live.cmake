# live.cmake - the library for the page of `view --live`. It is kept, compiled, in the folder `kept` (keep.sh makes it):
# who installs isoroll needs no emscripten. Sets live: the two files of it, or nothing.
option(ISO_LIVE "The page of view --live" ON)
option(ISO_LIVE_BUILD "Compile its library anew, where emscripten and the sources of GSL and libyaml are" OFF)
set(ISO_LIVE_SOURCES ${PROJECT_SOURCE_DIR}/.build/live-sources CACHE PATH "What apps/live/sources.sh has got")
find_program(ISO_EMCMAKE emcmake DOC "of emscripten, for ISO_LIVE_BUILD")
mark_as_advanced(ISO_EMCMAKE)
file(GLOB found ${ISO_LIVE_SOURCES}/gsl-* ${ISO_LIVE_SOURCES}/libyaml-*)
set(live)
if(ISO_LIVE)
  set(folder ${CMAKE_CURRENT_LIST_DIR}/kept)
  set(live ${folder}/isoroll.js ${folder}/library.txt)
endif()
if(ISO_LIVE AND ISO_LIVE_BUILD AND ISO_EMCMAKE AND found)
  set(folder ${PROJECT_BINARY_DIR}/live)
  set(live ${folder}/isoroll.js ${folder}/library.txt)
  file(GLOB_RECURSE depends CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/*.c ${PROJECT_SOURCE_DIR}/lib/*.h)
  file(GLOB own CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.*)
  add_custom_command(OUTPUT ${live} DEPENDS ${depends} ${own} VERBATIM COMMENT "The library as WebAssembly (view --live)"
    COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs ${ISO_EMCMAKE} ${CMAKE_COMMAND}
      -S ${CMAKE_CURRENT_LIST_DIR} -B ${folder} -DISO_LIVE_SOURCES=${ISO_LIVE_SOURCES} --log-level=WARNING
    COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs ${CMAKE_COMMAND} --build ${folder} --parallel 2
    COMMAND ${CMAKE_COMMAND} -E touch ${live})
  add_custom_target(live DEPENDS ${live})
elseif(ISO_LIVE AND ISO_LIVE_BUILD)
  message(STATUS "no emscripten, or no sources in ${ISO_LIVE_SOURCES} (apps/live/sources.sh): view --live has the kept "
    "library")
endif()
