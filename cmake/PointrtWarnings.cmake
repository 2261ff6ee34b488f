# SPDX-License-Identifier: Apache-2.0
# The warnings every target of this project is compiled with.
# Other people's headers come in as system includes (imported targets, or SYSTEM), so that theirs stay silent.

add_compile_options(-Wall -Wextra -Wshadow)
# GCC 12 takes "text" + std::string for overlapping copies (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict)
endif()
if(POINTRT_WERROR)
  add_compile_options(-Werror)
endif()
