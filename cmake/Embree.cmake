# SPDX-License-Identifier: Apache-2.0
# pointrt_embree: Embree 3 or 4, whichever is there, for tests/support/embree.h.
include_guard(GLOBAL)
find_package(embree REQUIRED)
if(NOT embree_VERSION_MAJOR MATCHES "^[34]$")
  message(FATAL_ERROR "Embree ${embree_VERSION} is here, the tests are written for Embree 3 and 4")
endif()
add_library(pointrt_embree INTERFACE)
target_link_libraries(pointrt_embree INTERFACE embree)
target_compile_definitions(pointrt_embree INTERFACE POINTRT_EMBREE_MAJOR=${embree_VERSION_MAJOR})
