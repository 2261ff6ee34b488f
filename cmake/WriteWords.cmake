# SPDX-License-Identifier: Apache-2.0
# cmake -DINPUT=FILE -DOUTPUT=FILE.h -DNAME=NAME -P WriteWords.cmake: a file of little-endian 32-bit words as
#   const uint32_t NAME[] = {...};
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
string(REGEX REPLACE "(0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,0x[^,]*,)" "\\1\n" words "${words}")
file(WRITE ${OUTPUT} "#pragma once\nconst uint32_t ${NAME}[] = {\n${words}};\n")
