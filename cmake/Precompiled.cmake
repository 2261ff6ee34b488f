# SPDX-License-Identifier: Apache-2.0
# pointrt_precompile(): the headers of other people that most sources want are read once, not once a source, which takes
# half of a build. Called when all targets stand. Each target takes the set of headers that what it links allows.
# Only where there is no ccache: that would have to be told to overlook things, and what it keeps is faster still. So
# builds with it see whether each source includes what it uses, as does the asan preset.
include_guard(GLOBAL)

option(POINTRT_PRECOMPILE "Read other people's headers once, not once a source" ${POINTRT_WITHOUT_CCACHE})
# Lines without variables are enough to know where a program was, and take a tenth less.
if(POINTRT_PRECOMPILE AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  add_compile_options($<$<CONFIG:RelWithDebInfo>:-g1>)
endif()

set(POINTRT_STANDARD_HEADERS
  <algorithm> <array> <atomic> <bit> <charconv> <chrono> <cmath> <condition_variable> <cstddef> <cstdint> <cstdio> <cstdlib>
  <cstring> <filesystem> <fstream> <functional> <iomanip> <limits> <map> <memory> <mutex> <numbers> <numeric> <optional>
  <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <system_error> <thread> <unordered_map> <utility>
  <variant> <vector>)

# What the sources of `target` may include headers of, through all that it links.
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

# Tests run for seconds and are compiled for minutes. Headers are read by the options that they were precompiled with.
function(pointrt_optimize_less target)
  if("GTest::gtest" IN_LIST links AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-Og>)
  endif()
endfunction()

# The target that holds the headers which sources with these links share; made where it is new. Code of theirs that is
# made otherwise, as `code` has it, needs headers that are.
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
# add) or "other", of which there is too little for headers of its own.
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
  # the libraries whose headers are among them: what a folder found is known in that folder
  if(POINTRT_BUILD_BAKE)
    find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  endif()
  if(POINTRT_BUILD_TESTS)
    find_package(GTest REQUIRED)
  endif()
  # not those of the build's folder, where an earlier configuration may have left some
  get_property(added DIRECTORY ${PROJECT_SOURCE_DIR} PROPERTY SUBDIRECTORIES)
  foreach(room IN ITEMS format preprocess runtime tests)
    if(${PROJECT_SOURCE_DIR}/${room} IN_LIST added)
      pointrt_precompile_folder(${PROJECT_SOURCE_DIR}/${room})
    endif()
  endforeach()
endfunction()
