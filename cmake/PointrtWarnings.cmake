# SPDX-License-Identifier: Apache-2.0
# The warnings every target of this project is compiled with.
# Other people's headers come in as system includes (imported targets, or SYSTEM), so that theirs stay silent.

add_compile_options(-Wall -Wextra -Wshadow)
if(POINTRT_WERROR)
  add_compile_options(-Werror)
endif()
