# SPDX-License-Identifier: Apache-2.0
# CPack runs this when the files of the packages lie in their folders: Debian wants a copyright file and a changelog in
# each, manual pages compressed, nothing in programs that nobody reads, and reasons for what lintian finds.
set(here ${CMAKE_CURRENT_LIST_DIR})

if(DEFINED ENV{SOURCE_DATE_EPOCH})
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # which heeds SOURCE_DATE_EPOCH
else()
  string(TIMESTAMP date "%a, %d %b %Y 00:00:00 +0000" UTC)
endif()

function(compress file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# As dh_strip does.
function(dropComments)
  foreach(file IN LISTS ARGN)
    execute_process(COMMAND strip --strip-debug --remove-section=.comment --enable-deterministic-archives ${file}
      COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endfunction()

foreach(component IN ITEMS tools dev docs)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  set(doc ${root}/share/doc/${package})
  file(COPY ${here}/copyright DESTINATION ${doc} FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(WRITE ${doc}/changelog "pointrt (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * As its developers build it; CHANGELOG.md in pointrt-doc says what is new.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  compress(${doc}/changelog)
  if(EXISTS ${here}/${package}.lintian-overrides)
    configure_file(${here}/${package}.lintian-overrides ${root}/share/lintian/overrides/${package} COPYONLY
      FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  endif()
  file(GLOB code ${root}/bin/* ${root}/lib/*/*.a)
  dropComments(${code})
  file(GLOB pages ${root}/share/man/man1/*.1)
  foreach(page IN LISTS pages)
    compress(${page})
  endforeach()
endforeach()
