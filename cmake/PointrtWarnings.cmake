# SPDX-License-Identifier: Apache-2.0
# The warnings every target of this project is compiled with, and the stricter set a target can ask for.
# Other people's headers come in as system includes (imported targets, or SYSTEM), so that theirs stay silent.

add_compile_options(-Wall -Wextra -Wshadow)
if(POINTRT_WERROR)
  add_compile_options(-Werror)
endif()

# pointrt_warnings(TARGET... [CONVERSION]): CONVERSION adds -Wconversion.
function(pointrt_warnings)
  cmake_parse_arguments(PARSE_ARGV 0 arg "CONVERSION" "" "")
  foreach(target IN LISTS arg_UNPARSED_ARGUMENTS)
    if(arg_CONVERSION)
      target_compile_options(${target} PRIVATE -Wconversion)
    endif()
  endforeach()
endfunction()
