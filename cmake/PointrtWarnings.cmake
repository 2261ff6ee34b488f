# SPDX-License-Identifier: Apache-2.0
# The warnings every target of this project is compiled with.
# Headers of other projects are system includes (imported targets, or SYSTEM), so they give no warnings.

add_compile_options(-Wall -Wextra -Wshadow)
# GCC 12 mistakes "text" + std::string for overlapping copies (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict)
endif()
# GCC 13 and later take each function with a temporary argument that returns a reference for one that returns that argument.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  add_compile_options(-Wno-dangling-reference)
endif()
if(POINTRT_WERROR)
  add_compile_options(-Werror)
endif()
# It mistakes our formats for those of Microsoft's old C library, which mingw-w64 replaces; other compilers check them.
if(MINGW)
  add_compile_options(-Wno-format -Wno-format-extra-args)
endif()
# With precompiled headers GCC's optimiser warns more about the library's own strings and vectors; all warnings examined were
# false. Four kinds are turned off there, and the others are not errors. Builds without precompiled headers check all of them.
if(POINTRT_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(out_of_library array-bounds maybe-uninitialized stringop-overflow stringop-overread)
  foreach(warning IN LISTS out_of_library
      ITEMS dangling-pointer free-nonheap-object nonnull use-after-free)
    add_compile_options(-Wno-error=${warning})
    if(warning IN_LIST out_of_library)
      add_compile_options(-Wno-${warning})
    endif()
  endforeach()
endif()
