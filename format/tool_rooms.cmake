# SPDX-License-Identifier: Apache-2.0
# Rooms that all four tools share. They are not installed.
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)

pointrt_room(format/os OF_SYSTEM
  EXCLUDE atomic_file.cpp atomic_file_windows.cpp mapped_file.cpp mapped_file_windows.cpp
  PURPOSE "What differs between systems: files, locks, processes, signals, memory, libraries, terminals, the user's folders.")
target_sources(pointrt_os PRIVATE $<TARGET_OBJECTS:pointrt_os_objects>)
target_link_libraries(pointrt_os PRIVATE ${CMAKE_DL_LIBS})
target_compile_options(pointrt_os PRIVATE -Wconversion)
if(WIN32)
  # Names of files are UTF-8 in all programs: by their manifest (WindowsResources), and by utf8_names_windows.cpp.
  target_link_options(pointrt_os INTERFACE -Wl,--wrap=mbrtowc,--wrap=fopen,--wrap=fopen64,-u,__wrap_mbrtowc)
  target_link_libraries(pointrt_os PRIVATE psapi)
endif()

pointrt_room(format/base USES format/include/pointrt format/os
  PURPOSE "Errors, report files, parallel loops, time left, names and text for users.")

pointrt_room(format/index USES format/include/pointrt format/base format/os
  PURPOSE "The tracing index of a .pro: bricks of cells, their lists of splats, the grid of entry points.")
target_compile_options(pointrt_index PRIVATE -ffp-contract=off) # the same rounding on every processor

pointrt_room(format/set USES format/include/pointrt format/base format/os
  PURPOSE "Tile sets (NAME.proset): set.json read, written and checked, and where tiles lie.")
target_link_libraries(pointrt_set PRIVATE nlohmann_json::nlohmann_json)
target_compile_options(pointrt_set PRIVATE -Wconversion)

pointrt_room(format/cli USES format/base format/os
  PURPOSE "Command lines: what all tools share, and the manual pages and shell completions made of the options.")
target_link_libraries(pointrt_cli PUBLIC $<BUILD_INTERFACE:CLI11::CLI11>)

pointrt_room(format/crs USES format/base format/os
  PURPOSE "Coordinate systems: WKT, EPSG codes, and names, units, areas and meridian convergence by PROJ.")
# The header only: the library is opened at run time.
find_path(PROJ_INCLUDE_DIR proj.h REQUIRED)
target_include_directories(pointrt_crs SYSTEM PRIVATE ${PROJ_INCLUDE_DIR})
target_link_libraries(pointrt_crs PRIVATE nlohmann_json::nlohmann_json)
target_compile_options(pointrt_crs PRIVATE -Wconversion)

# LAZ and E57 are read by Rust crates, where there is a Rust compiler.
set(POINTRT_LAZ_E57 AUTO CACHE STRING "Read LAZ and E57 files (needs Rust): AUTO, ON or OFF")
set_property(CACHE POINTRT_LAZ_E57 PROPERTY STRINGS AUTO ON OFF)
set(pointio ${CMAKE_CURRENT_SOURCE_DIR}/pointio)
set(has_rust FALSE)
if(NOT POINTRT_LAZ_E57 STREQUAL "OFF")
  include(Rust)
  pointrt_find_rust(why_not ${pointio})
  if(NOT why_not)
    set(has_rust TRUE)
  elseif(POINTRT_LAZ_E57 STREQUAL "AUTO")
    message(STATUS "Without LAZ and E57 files: ${why_not}")
  else()
    message(FATAL_ERROR "POINTRT_LAZ_E57 is ON, but ${why_not}")
  endif()
endif()
set(unused_readers e57.cpp laz.cpp)
if(has_rust)
  list(TRANSFORM unused_readers REPLACE "\\.cpp$" "_absent.cpp")
endif()
pointrt_room(format/pointio USES format/include/pointrt format/base format/os format/crs format/set
  EXCLUDE ${unused_readers}
  PURPOSE "Points with named columns read and written: .pro, tile sets, PLY, PCD, text, LAS, LAZ, E57, headers of NumPy.")
target_link_libraries(pointrt_pointio PUBLIC fmt::fmt nlohmann_json::nlohmann_json)
target_compile_options(pointrt_pointio PRIVATE -Wconversion)
if(has_rust)
  pointrt_rust_library(pointrt_pointio_rs ${pointio})
  target_link_libraries(pointrt_pointio PRIVATE pointrt_pointio_rs)
endif()

file(GLOB info_sources CONFIGURE_DEPENDS info/*.cpp)
pointrt_folder(format/info USES format/include/pointrt format/base format/os format/cli format/pointio format/set
  PURPOSE "pointrt-info: prints, verifies and exports files and tile sets.")
