# SPDX-License-Identifier: Apache-2.0
# pointrt_embed_shaders(TARGET [AS_WRITTEN] FILE.STAGE.glsl...): compiles each shader and lets TARGET's sources include
# the result:
#   #include "shaders/NAME.spv.h"     defines const uint32_t NAME_spv[]
# NAME is the file's name up to the first dot, and _vert or _frag after it for those stages. Rebuilt when the shader or
# anything it includes changes; optimised by spirv-opt, unless AS_WRITTEN, and checked by spirv-val, if those are
# installed.
# pointrt_embed_shaders(TARGET [AS_WRITTEN] VARIANT name FILE...): with NAME (capitals) defined, as FILE_name.
find_program(POINTRT_GLSLANG glslangValidator REQUIRED DOC "GLSL compiler")
find_program(POINTRT_SPIRV_OPT spirv-opt DOC "SPIR-V optimizer, optional: drivers then build programs in half the time")
find_program(POINTRT_SPIRV_VAL spirv-val DOC "SPIR-V validator, optional")

function(pointrt_embed_shaders target)
  cmake_parse_arguments(PARSE_ARGV 1 arg AS_WRITTEN VARIANT "")
  # Does half of the work of a driver's compiler. Not simplify-instructions, and therefore neither -O nor -Os: it reorders
  # products of floats, so pictures would depend on whether spirv-opt is installed.
  set(passes
    --eliminate-dead-branches --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions
    --private-to-local --scalar-replacement=0 --ssa-rewrite --ccp --eliminate-dead-branches
    --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store --ssa-rewrite
    --copy-propagate-arrays --vector-dce --eliminate-dead-inserts --eliminate-dead-code-aggressive --merge-blocks
    --if-conversion --local-redundancy-elimination --eliminate-dead-code-aggressive --cfg-cleanup --strip-debug)
  set(words_script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/WriteWords.cmake)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(flags --quiet --target-env vulkan1.2 -I${PROJECT_SOURCE_DIR} -I${PROJECT_SOURCE_DIR}/format/include)
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
    set(optimize "")
    if(POINTRT_SPIRV_OPT AND NOT arg_AS_WRITTEN)
      # keeps unused bindings, because one descriptor set serves several programs
      set(optimize COMMAND ${POINTRT_SPIRV_OPT} --target-env=vulkan1.2 --preserve-bindings
        ${passes} ${output} -o ${output})
    endif()
    set(validate "")
    if(POINTRT_SPIRV_VAL)
      set(validate COMMAND ${POINTRT_SPIRV_VAL} --target-env vulkan1.2 ${output})
    endif()
    add_custom_command(
      OUTPUT ${output} ${output}.h
      COMMAND ${POINTRT_GLSLANG} ${flags} -V --depfile ${output}.d -o ${output} ${source}
      ${optimize}
      ${validate}
      COMMAND ${CMAKE_COMMAND} -DINPUT=${output} -DOUTPUT=${output}.h -DNAME=${name}_spv -P ${words_script}
      DEPENDS ${source} ${words_script}
      DEPFILE ${output}.d
      COMMENT "Compiling shader ${name}"
      VERBATIM)
    target_sources(${target} PRIVATE ${output}.h)
  endforeach()
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
