# SPDX-License-Identifier: Apache-2.0
# A room is a folder of sources with one purpose, built as one library.
#
# pointrt_room(FOLDER [OF_SYSTEM] PURPOSE "one line" [USES folder...] [EXCLUDE file...] [TARGET target]): all .cpp files
# of FOLDER as the library TARGET, by default pointrt_FOLDER (runtime/window/ui: pointrt_window_ui); headers alone make
# an interface library. OF_SYSTEM: NAME_windows.cpp is built for Windows, in the place of NAME.cpp. USES are the rooms,
# as paths from the repository's root, whose headers it may include; it is linked to them. tests/structure checks the
# #include lines against that list.
# pointrt_system_sources(LIST): leaves in the list LIST the sources that this system is built of.
# pointrt_folder(FOLDER PURPOSE "one line" [USES folder...] [TARGET target]): the same for a folder that is not such a
# library; rooms that use it are linked to TARGET.
# pointrt_room_objects(RESULT FOLDER...): the objects of these rooms and of all that they use, without pointrt_pro's.
# pointrt_write_rooms(): writes FOLDER|uses, separated by spaces|purpose of each room to rooms.txt in the build folder.
include_guard(GLOBAL)

function(pointrt_system_sources list)
  set(all ${${list}})
  set(for_windows ${all})
  list(FILTER for_windows INCLUDE REGEX "_windows\\.cpp$")
  if(WIN32)
    list(TRANSFORM for_windows REPLACE "_windows\\.cpp$" ".cpp")
  endif()
  if(for_windows)
    list(REMOVE_ITEM all ${for_windows})
  endif()
  set(${list} ${all} PARENT_SCOPE)
endfunction()

function(pointrt_folder folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PURPOSE;TARGET" USES)
  list(JOIN arg_USES " " uses)
  set_property(GLOBAL APPEND PROPERTY POINTRT_ROOMS "${folder}|${uses}|${arg_PURPOSE}")
  set_property(GLOBAL PROPERTY POINTRT_TARGET_${folder} ${arg_TARGET})
endfunction()

# pointrt_room_target(RESULT FOLDER): the library that a room is built as.
function(pointrt_room_target result folder)
  get_property(target GLOBAL PROPERTY POINTRT_TARGET_${folder})
  if(NOT target)
    message(FATAL_ERROR "${folder} is not a room that has been added yet")
  endif()
  set(${result} ${target} PARENT_SCOPE)
endfunction()

function(pointrt_room folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OF_SYSTEM" "PURPOSE;TARGET" "USES;EXCLUDE")
  string(REGEX REPLACE "^[a-z]+/(.*)$" "pointrt_\\1" target ${folder})
  string(REPLACE "/" "_" target ${target})
  if(arg_TARGET)
    set(target ${arg_TARGET})
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  if(arg_OF_SYSTEM)
    pointrt_system_sources(sources)
  endif()
  list(TRANSFORM arg_EXCLUDE PREPEND ${PROJECT_SOURCE_DIR}/${folder}/)
  list(REMOVE_ITEM sources ${arg_EXCLUDE})
  set(scope INTERFACE)
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    pointrt_unite(${target})
  else()
    add_library(${target} INTERFACE)
  endif()
  target_include_directories(${target} ${scope} ${PROJECT_SOURCE_DIR})
  target_compile_features(${target} ${scope} cxx_std_20)
  foreach(used IN LISTS arg_USES)
    pointrt_room_target(library ${used})
    target_link_libraries(${target} ${scope} ${library})
  endforeach()
  pointrt_folder(${folder} PURPOSE "${arg_PURPOSE}" USES ${arg_USES} TARGET ${target})
endfunction()

function(pointrt_room_objects result)
  set(rooms "")
  foreach(folder IN LISTS ARGN)
    pointrt_room_target(library ${folder})
    list(APPEND rooms ${library})
  endforeach()
  set(seen "")
  while(rooms)
    list(POP_FRONT rooms room)
    get_target_property(type ${room} TYPE)
    if(room IN_LIST seen OR room MATCHES "^pointrt(_|::)pro$")
      continue()
    endif()
    list(APPEND seen ${room})
    if(type STREQUAL "STATIC_LIBRARY")
      list(APPEND objects $<TARGET_OBJECTS:${room}>)
      set_target_properties(${room} PROPERTIES POSITION_INDEPENDENT_CODE ON) # other people's shared libraries link them
    endif()
    get_target_property(used ${room} INTERFACE_LINK_LIBRARIES)
    foreach(each IN LISTS used)
      if(TARGET ${each} AND each MATCHES "^pointrt_")
        list(APPEND rooms ${each})
      endif()
    endforeach()
  endwhile()
  set(${result} ${objects} PARENT_SCOPE)
endfunction()

function(pointrt_write_rooms)
  get_property(rooms GLOBAL PROPERTY POINTRT_ROOMS)
  list(JOIN rooms "\n" text)
  file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/rooms.txt CONTENT "${text}\n")
endfunction()
