# SPDX-License-Identifier: Apache-2.0
# Toolchain: builds programs for 64-bit Windows with Debian's g++-mingw-w64-x86-64-posix; they need only system libraries.
#   cmake --toolchain cmake/mingw-w64.cmake -D POINTRT_WINDOWS_LIBRARIES=FOLDER ...
# FOLDER is made by packaging/windows/libraries.sh.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

set(POINTRT_WINDOWS_LIBRARIES "" CACHE PATH "What packaging/windows/libraries.sh made")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES POINTRT_WINDOWS_LIBRARIES)
set(CMAKE_FIND_ROOT_PATH ${POINTRT_WINDOWS_LIBRARIES} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind IN ITEMS LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(ENV{PKG_CONFIG_LIBDIR} ${POINTRT_WINDOWS_LIBRARIES}/lib/pkgconfig) # not this system's
set(ZLIB_USE_STATIC_LIBS ON)
# -static: for GCC's libraries and winpthreads. Stacks of 8 MiB, as on Linux; the linker's default is 2. Programs and
# libraries contain no date.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--stack,8388608 -Wl,--no-insert-timestamp")
set(CMAKE_SHARED_LINKER_FLAGS_INIT -Wl,--no-insert-timestamp)
set(CMAKE_MODULE_LINKER_FLAGS_INIT "-static -Wl,--no-insert-timestamp")
