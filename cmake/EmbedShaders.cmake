# SPDX-License-Identifier: Apache-2.0
# pointrt_embed_shaders(TARGET FILE.STAGE.glsl...): compiles each shader and lets TARGET's sources include the result:
#   #include "shaders/NAME.spv.h"     defines const uint32_t NAME_spv[]
# NAME is the file's name up to the first dot, and _vert or _frag after it for those stages. Rebuilt when the shader or
# anything it includes changes; checked by spirv-val where that is installed.
# pointrt_embed_shaders(TARGET VARIANT name FILE...): with NAME (capitals) defined, as FILE_name.
find_program(POINTRT_GLSLANG glslangValidator REQUIRED DOC "GLSL compiler")
find_program(POINTRT_SPIRV_VAL spirv-val DOC "SPIR-V validator, optional")

function(pointrt_embed_shaders target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" VARIANT "")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(flags --quiet --target-env vulkan1.2 -I${PROJECT_SOURCE_DIR}/shaders -I${PROJECT_SOURCE_DIR}/format/include)
  if(arg_VARIANT)
    string(TOUPPER -D${arg_VARIANT} define)
    list(APPEND flags ${define})
  endif()
  file(MAKE_DIRECTORY ${folder}/shaders)
  foreach(source IN LISTS arg_UNPARSED_ARGUMENTS)
    cmake_path(ABSOLUTE_PATH source NORMALIZE)
    get_filename_component(name ${source} NAME_WE)
    if(source MATCHES "\\.(vert|frag)\\.glsl$")
      string(APPEND name _${CMAKE_MATCH_1})
    endif()
    if(arg_VARIANT)
      string(APPEND name _${arg_VARIANT})
    endif()
    set(output ${folder}/shaders/${name}.spv)
    set(validate "")
    if(POINTRT_SPIRV_VAL)
      set(validate COMMAND ${POINTRT_SPIRV_VAL} --target-env vulkan1.2 ${output})
    endif()
    # --vn writes text, which spirv-val does not read, so that the shader is compiled twice.
    add_custom_command(
      OUTPUT ${output}.h
      BYPRODUCTS ${output}
      COMMAND ${POINTRT_GLSLANG} ${flags} -V -o ${output} ${source}
      ${validate}
      COMMAND ${POINTRT_GLSLANG} ${flags} -V --vn ${name}_spv --depfile ${output}.h.d -o ${output}.h ${source}
      DEPENDS ${source}
      DEPFILE ${output}.h.d
      COMMENT "Compiling shader ${name}"
      VERBATIM)
    target_sources(${target} PRIVATE ${output}.h)
  endforeach()
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
