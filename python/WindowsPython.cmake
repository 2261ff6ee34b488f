# SPDX-License-Identifier: Apache-2.0
# In the place of find_package(Python), where the module is built for another system than the one that builds it: that
# Python's headers and its stable interface (python3.dll), which all later versions have, and this system's interpreter.
file(STRINGS ${POINTRT_WINDOWS_PYTHON}/include/patchlevel.h version REGEX "^#define PY_VERSION ")
string(REGEX MATCH "[0-9]+\\.[0-9]+" Python_VERSION "${version}")
if(Python_VERSION VERSION_LESS 3.12)
  message(FATAL_ERROR "${POINTRT_WINDOWS_PYTHON}: Python 3.12 or later is needed, whose stable interface nanobind uses")
endif()
set(Python_INTERPRETER_ID Python)
set(Python_INCLUDE_DIRS ${POINTRT_WINDOWS_PYTHON}/include)
set(Python_SOSABI "") # _core.pyd
foreach(kind IN ITEMS Module SABIModule)
  add_library(Python::${kind} INTERFACE IMPORTED)
  target_link_libraries(Python::${kind} INTERFACE ${POINTRT_WINDOWS_PYTHON}/libs/python3.lib)
endforeach()
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(Python_EXECUTABLE ${Python3_EXECUTABLE})
add_executable(Python::Interpreter ALIAS Python3::Interpreter)
