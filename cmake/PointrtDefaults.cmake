# SPDX-License-Identifier: Apache-2.0
# What a build gets when the user names nothing else: an optimised build, and ccache where there is one.

get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT is_multi_config AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, RelWithDebInfo or Debug" FORCE)
endif()

find_program(POINTRT_CCACHE ccache)
mark_as_advanced(POINTRT_CCACHE)
if(POINTRT_CCACHE)
  foreach(language C CXX)
    if(NOT CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER ${POINTRT_CCACHE})
    endif()
  endforeach()
endif()

# the default of what makes builds from nothing faster where ccache keeps nothing
set(POINTRT_WITHOUT_CCACHE ON)
if(POINTRT_CCACHE)
  set(POINTRT_WITHOUT_CCACHE OFF)
endif()
