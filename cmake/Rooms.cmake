# SPDX-License-Identifier: Apache-2.0
# pointrt_room(TARGET PURPOSE "one line" [SOURCES file...] [USES target...]): this folder as a library. USES are the
# rooms whose headers it may include; they are linked. tests/structure holds the includes against that.
# pointrt_folder(FOLDER PURPOSE "one line" [USES folder...]): the same of a folder that is no library of C++.
# pointrt_write_rooms(): FOLDER|uses, space apart|purpose of each room, to rooms.txt in the build folder.
include_guard(GLOBAL)

function(pointrt_folder folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" PURPOSE USES)
  list(JOIN arg_USES " " uses)
  set_property(GLOBAL APPEND PROPERTY POINTRT_ROOMS "${folder}|${uses}|${arg_PURPOSE}")
endfunction()

function(pointrt_room target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" PURPOSE "SOURCES;USES")
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} ${PROJECT_SOURCE_DIR})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_link_libraries(${target} ${scope} ${arg_USES})
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
  set_target_properties(${target} PROPERTIES POINTRT_FOLDER ${folder})
  set(folders "")
  foreach(used IN LISTS arg_USES)
    get_target_property(used_folder ${used} POINTRT_FOLDER)
    list(APPEND folders ${used_folder})
  endforeach()
  pointrt_folder(${folder} PURPOSE "${arg_PURPOSE}" USES ${folders})
endfunction()

function(pointrt_write_rooms)
  get_property(rooms GLOBAL PROPERTY POINTRT_ROOMS)
  list(JOIN rooms "\n" text)
  file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/rooms.txt CONTENT "${text}\n")
endfunction()
