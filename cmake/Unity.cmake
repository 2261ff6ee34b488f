# SPDX-License-Identifier: Apache-2.0
# pointrt_unite(TARGET): compiles a room or a test program in batches of sources rather than one by one, so that each
# batch reads its headers once. Only where there is no ccache, since a changed source then costs its whole batch. Builds
# with ccache, and the asan preset, see whether each source includes what it uses. In a batch, names in anonymous
# namespaces must differ: tests/structure checks that.
# pointrt_write_united(): writes TARGET|sources, separated by spaces, to united.txt in the build folder, for each target
# that may be compiled in batches, without the sources that are left out of them (SKIP_UNITY_BUILD_INCLUSION).
include_guard(GLOBAL)

option(POINTRT_UNITY "Compile sources in batches, each of which reads headers once" ${POINTRT_WITHOUT_CCACHE})

set(POINTRT_UNITY_BATCH 10) # of 6 to 40 sources a room: larger batches no longer fill two cores evenly

function(pointrt_unite target)
  set_property(GLOBAL APPEND PROPERTY POINTRT_UNITED ${target})
  if(NOT POINTRT_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${POINTRT_UNITY_BATCH})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC takes the sources of a batch for headers, whose types must not have members of anonymous namespaces
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

function(pointrt_write_united)
  get_property(targets GLOBAL PROPERTY POINTRT_UNITED)
  set(text "")
  foreach(target IN LISTS targets)
    get_target_property(unity ${target} UNITY_BUILD)
    if(NOT unity AND NOT unity MATCHES "NOTFOUND$") # turned off
      continue()
    endif()
    get_target_property(folder ${target} SOURCE_DIR)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    list(FILTER sources EXCLUDE REGEX "^${CMAKE_BINARY_DIR}/") # generated
    set(united "")
    foreach(source IN LISTS sources)
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
      get_source_file_property(skipped ${source} TARGET_DIRECTORY ${target} SKIP_UNITY_BUILD_INCLUSION)
      if(NOT skipped)
        file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${source})
        list(APPEND united ${path})
      endif()
    endforeach()
    list(JOIN united " " paths)
    string(APPEND text "${target}|${paths}\n")
  endforeach()
  file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/united.txt CONTENT "${text}")
endfunction()
