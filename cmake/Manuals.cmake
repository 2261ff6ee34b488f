# SPDX-License-Identifier: Apache-2.0
# pointrt_manuals(TOOL [COMMAND...]): manual pages and completions of a tool and of its commands, which it makes itself
# of the options that it parses, built with it and installed. Where a cross compiler's programs do not run
# (CMAKE_CROSSCOMPILING_EMULATOR), the tool's --generate makes them later.
include_guard(GLOBAL)
include(GNUInstallDirs)

# Debian's zsh looks into zsh/vendor-completions.
set(POINTRT_ZSH_COMPLETIONS ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING "Where zsh's completions go")
mark_as_advanced(POINTRT_ZSH_COMPLETIONS)

# What `TOOL WORDS... --generate KIND` prints, as FILE.
function(pointrt_generated file tool kind)
  add_custom_command(OUTPUT ${file} COMMAND ${tool} ${ARGN} --generate ${kind} > ${file} DEPENDS ${tool} VERBATIM)
  set_property(TARGET ${tool} APPEND PROPERTY POINTRT_GENERATED ${file})
endfunction()

function(pointrt_manuals tool)
  if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    message(STATUS "${tool}: no manual page and no completions, since it does not run here: ${tool} --generate")
    return()
  endif()
  set(folder ${CMAKE_BINARY_DIR}/manuals)
  file(MAKE_DIRECTORY ${folder})
  pointrt_generated(${folder}/${tool}.1 ${tool} man)
  foreach(command IN LISTS ARGN)
    pointrt_generated(${folder}/${tool}-${command}.1 ${tool} man ${command})
  endforeach()
  get_target_property(pages ${tool} POINTRT_GENERATED)
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)

  pointrt_generated(${folder}/${tool}.bash ${tool} bash)
  pointrt_generated(${folder}/_${tool} ${tool} zsh)
  pointrt_generated(${folder}/${tool}.fish ${tool} fish)
  install(FILES ${folder}/${tool}.bash RENAME ${tool}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tools)
  install(FILES ${folder}/_${tool} DESTINATION ${POINTRT_ZSH_COMPLETIONS} COMPONENT tools)
  install(FILES ${folder}/${tool}.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tools)

  get_target_property(files ${tool} POINTRT_GENERATED)
  add_custom_target(${tool}-manuals ALL DEPENDS ${files})
endfunction()
