# SPDX-License-Identifier: Apache-2.0
# pointrt_unite(TARGET): compiles a room or a test program in batches of sources rather than one by one, so that each
# batch reads its headers once. Only where there is no ccache, since a changed source then costs its whole batch. Builds
# with ccache, and the asan preset, see whether each source includes what it uses. In a batch, names in anonymous
# namespaces must differ.
include_guard(GLOBAL)

option(POINTRT_UNITY "Compile sources in batches, each of which reads headers once" ${POINTRT_WITHOUT_CCACHE})

set(POINTRT_UNITY_BATCH 10) # of 6 to 40 sources a room: larger batches no longer fill two cores evenly

function(pointrt_unite target)
  if(NOT POINTRT_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${POINTRT_UNITY_BATCH})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC takes the sources of a batch for headers, whose types must not have members of anonymous namespaces
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()
