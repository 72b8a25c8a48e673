# finish.cmake - CPack runs this after it has installed all components into folders of their own, before it makes
# packages of them. It adds copyright and changelogs, compresses what Debian has compressed, and sets the dates.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # of SOURCE_DATE_EPOCH
set(changelog "isoroll (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * Made by CPack from the sources. What changed is in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")

file(GLOB folders LIST_DIRECTORIES true ${CPACK_TEMPORARY_DIRECTORY}/*)
foreach(folder IN LISTS folders)
  if(NOT IS_DIRECTORY ${folder}/usr)
    continue()
  endif()
  cmake_path(GET folder FILENAME package)
  set(documents ${folder}/usr/share/doc/${package})
  file(MAKE_DIRECTORY ${documents})
  configure_file(${CPACK_ISO_SOURCE}/apps/packaging/copyright ${documents}/copyright COPYONLY)
  configure_file(${CPACK_ISO_SOURCE}/lib/doc/changelog.md ${documents}/changelog COPYONLY)
  file(WRITE ${documents}/changelog.Debian "${changelog}")
  file(GLOB_RECURSE pc ${folder}/usr/*/isoroll.pc)
  if(pc)
    file(READ ${pc} text)
    string(REPLACE " -Wl,-rpath,\${libdir}" "" text "${text}")
    file(WRITE ${pc} "${text}")
  endif()
  file(GLOB pages ${folder}/usr/share/man/*/*)
  execute_process(COMMAND gzip -9n ${documents}/changelog ${documents}/changelog.Debian ${pages}
    COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB_RECURSE files LIST_DIRECTORIES true ${folder}/*)
  execute_process(COMMAND touch -h -d @$ENV{SOURCE_DATE_EPOCH} ${folder} ${files} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
