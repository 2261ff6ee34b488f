# SPDX-License-Identifier: Apache-2.0
# pointrt_precompile(): precompiles the headers of other projects that most sources include, because reading them for each
# source takes half of a build. Call it after all targets are defined. Each target gets the headers of the libraries it links.
# Only without ccache, which would need special settings for this and is even faster. Builds with ccache, and the asan
# preset, check that each source includes what it uses.
include_guard(GLOBAL)

option(POINTRT_PRECOMPILE "Read other people's headers once, not once a source" ${POINTRT_WITHOUT_CCACHE})
# Debug information without variables is enough for stack traces, and saves a tenth of the time.
if(POINTRT_PRECOMPILE AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  add_compile_options($<$<CONFIG:RelWithDebInfo>:-g1>)
endif()

set(POINTRT_STANDARD_HEADERS
  <algorithm> <array> <atomic> <bit> <charconv> <chrono> <cmath> <condition_variable> <cstddef> <cstdint> <cstdio> <cstdlib>
  <cstring> <filesystem> <fstream> <functional> <iomanip> <limits> <map> <memory> <mutex> <numbers> <numeric> <optional>
  <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <system_error> <thread> <unordered_map> <utility>
  <variant> <vector>)

# The libraries whose headers the sources of `target` may include, through everything that it links.
function(pointrt_links result target)
  get_target_property(links ${target} POINTRT_LINKS)
  if(NOT links)
    set(links "")
    foreach(property IN ITEMS LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
      get_target_property(named ${target} ${property})
      foreach(library IN LISTS named)
        if(TARGET ${library}) # not so $<LINK_ONLY:...>: those headers stay with who uses them
          list(APPEND links ${library})
          pointrt_links(further ${library})
          list(APPEND links ${further})
        endif()
      endforeach()
    endforeach()
    list(REMOVE_DUPLICATES links)
    get_target_property(aliased ${target} ALIASED_TARGET)
    if(NOT aliased)
      set_property(TARGET ${target} PROPERTY POINTRT_LINKS "${links};-") # "-": looked up, and not empty
    endif()
  endif()
  set(${result} "${links}" PARENT_SCOPE)
endfunction()

# Tests run for seconds but compile for minutes. Headers must be used with the options that they were precompiled with.
function(pointrt_optimize_less target)
  if("GTest::gtest" IN_LIST links AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-Og>)
    # xxhash demands inlining that GCC 14 cannot do then
    target_compile_definitions(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:XXH_NO_INLINE_HINTS=1>)
  endif()
endfunction()

# The target with the precompiled headers for sources that link these libraries; created if it does not exist. Code compiled
# in another way (`code`) needs headers compiled in that way.
function(pointrt_header_set result links code)
  set(name pointrt_headers${code})
  set(headers ${POINTRT_STANDARD_HEADERS})
  set(libraries "")
  if("Eigen3::Eigen" IN_LIST links)
    string(APPEND name _eigen)
    list(APPEND headers <Eigen/Core> <Eigen/Geometry>)
    list(APPEND libraries Eigen3::Eigen)
  endif()
  if("GTest::gtest" IN_LIST links)
    string(APPEND name _gtest)
    list(APPEND headers <gtest/gtest.h>)
    list(APPEND libraries GTest::gtest)
  endif()
  if(NOT TARGET ${name})
    set(source ${PROJECT_BINARY_DIR}/precompiled/nothing.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// what CMake wants to see compiled with the headers\n")
    add_library(${name} OBJECT ${source})
    target_compile_features(${name} PRIVATE cxx_std_20)
    target_link_libraries(${name} PRIVATE ${libraries})
    target_precompile_headers(${name} PRIVATE ${headers})
    if(code STREQUAL "_shared")
      set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    elseif(code STREQUAL "_uncontracted")
      target_compile_options(${name} PRIVATE ${POINTRT_UNCONTRACTED})
    endif()
    pointrt_optimize_less(${name})
  endif()
  set(${result} ${name} PARENT_SCOPE)
endfunction()

# How a target's code is made: "" (by default), "_shared" (position independent), "_uncontracted" (no fused multiply and
# add) or "other", which is too rare for its own headers.
set(POINTRT_UNCONTRACTED -ffp-contract=off)
function(pointrt_code_of result target)
  get_target_property(shared ${target} POSITION_INDEPENDENT_CODE)
  get_target_property(visibility ${target} CXX_VISIBILITY_PRESET)
  get_target_property(options ${target} COMPILE_OPTIONS)
  list(FILTER options INCLUDE REGEX "^-[fO]|:-[fO]")
  if(options STREQUAL "" AND NOT shared)
    set(code "")
  elseif(options STREQUAL "" AND NOT visibility)
    set(code _shared)
  elseif(options STREQUAL POINTRT_UNCONTRACTED AND NOT shared)
    set(code _uncontracted)
  else()
    set(code other)
  endif()
  set(${result} "${code}" PARENT_SCOPE)
endfunction()

function(pointrt_precompile_target target)
  get_target_property(type ${target} TYPE)
  get_target_property(sources ${target} SOURCES)
  pointrt_links(links ${target})
  pointrt_code_of(code ${target})
  if(NOT type MATCHES "^(STATIC_LIBRARY|OBJECT_LIBRARY|EXECUTABLE)$" OR code STREQUAL "other"
      OR "CGAL::CGAL" IN_LIST links OR sources MATCHES "\\.c(;|$)")
    return()
  endif()
  pointrt_header_set(headers "${links}" "${code}")
  target_precompile_headers(${target} REUSE_FROM ${headers})
  pointrt_optimize_less(${target})
endfunction()

# All targets of `folder` and below.
function(pointrt_precompile_folder folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    pointrt_precompile_target(${target})
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below IN LISTS folders)
    pointrt_precompile_folder(${below})
  endforeach()
endfunction()

function(pointrt_precompile)
  if(NOT POINTRT_PRECOMPILE)
    return()
  endif()
  # the libraries whose headers are included: imported targets are known only in the folder that found them
  if(POINTRT_BUILD_BAKE)
    find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  endif()
  if(POINTRT_BUILD_TESTS)
    find_package(GTest REQUIRED)
  endif()
  # not those in the build folder, which may be left over from an earlier configuration
  get_property(added DIRECTORY ${PROJECT_SOURCE_DIR} PROPERTY SUBDIRECTORIES)
  foreach(room IN ITEMS format preprocess runtime tests)
    if(${PROJECT_SOURCE_DIR}/${room} IN_LIST added)
      pointrt_precompile_folder(${PROJECT_SOURCE_DIR}/${room})
    endif()
  endforeach()
endfunction()
