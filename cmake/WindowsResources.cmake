# SPDX-License-Identifier: Apache-2.0
# pointrt_windows_resources(PROGRAM): for Windows, gives a program its manifest, icon and version.
include_guard(GLOBAL)

if(WIN32)
  enable_language(RC)
endif()

function(pointrt_windows_resources program)
  if(NOT WIN32)
    return()
  endif()
  set(packaging ${PROJECT_SOURCE_DIR}/packaging/windows)
  string(REPLACE "." "," numbers ${PROJECT_VERSION}.0) # four, the last of which counts builds
  set(resources ${CMAKE_CURRENT_BINARY_DIR}/${program}.rc)
  configure_file(${packaging}/program.rc.in ${resources} @ONLY)
  set_source_files_properties(${resources} PROPERTIES
    OBJECT_DEPENDS "${packaging}/pointrt.manifest;${packaging}/pointrt.ico")
  target_sources(${program} PRIVATE ${resources})
endfunction()
