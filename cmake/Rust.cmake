# SPDX-License-Identifier: Apache-2.0
# pointrt_find_rust(RESULT FOLDER): RESULT is "" if the crate in FOLDER can be built here, otherwise the reason why not. Checks
# once, and again when the crate's list of dependencies changes.
# pointrt_rust_library(TARGET FOLDER): the crate's static library; FOLDER's Cargo.toml names it libTARGET.a.
include_guard(GLOBAL)

# The version in Debian 13, which Cargo.toml requires.
set(POINTRT_RUST_OLDEST 1.85)
set(POINTRT_RUST_ADVICE
  "install Debian 12's cargo-web and rustc-web, Debian 13's cargo and rustc, or any Rust from ${POINTRT_RUST_OLDEST} on")

# For Windows, the crates are compiled for mingw-w64, with the system libraries that Rust's library needs.
set(POINTRT_RUST_TARGET "")
set(POINTRT_RUST_SYSTEM ${CMAKE_DL_LIBS} m)
if(MINGW)
  set(POINTRT_RUST_TARGET x86_64-pc-windows-gnu)
  set(POINTRT_RUST_SYSTEM ws2_32 userenv ntdll bcrypt advapi32)
endif()

find_program(POINTRT_CARGO cargo DOC "Builds what reads LAZ and E57 files")
find_program(POINTRT_RUSTC rustc DOC "Builds what reads LAZ and E57 files")
mark_as_advanced(POINTRT_CARGO POINTRT_RUSTC)

# The version of a Rust program; "" if it does not run.
function(pointrt_rust_version result program)
  set(${result} "" PARENT_SCOPE)
  if(program)
    execute_process(COMMAND ${program} --version OUTPUT_VARIABLE said ERROR_QUIET RESULT_VARIABLE status)
    if(status EQUAL 0 AND said MATCHES "([0-9]+\\.[0-9]+\\.[0-9]+)")
      set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
    endif()
  endif()
endfunction()

function(pointrt_find_rust result folder)
  foreach(program IN ITEMS CARGO RUSTC)
    pointrt_rust_version(version "${POINTRT_${program}}")
    string(TOLOWER ${program} name)
    if(NOT version)
      set(${result} "there is no ${name}: ${POINTRT_RUST_ADVICE}" PARENT_SCOPE)
      return()
    elseif(version VERSION_LESS POINTRT_RUST_OLDEST)
      set(${result} "${name} is ${version}: ${POINTRT_RUST_ADVICE}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  if(POINTRT_RUST_TARGET)
    execute_process(COMMAND ${POINTRT_RUSTC} --print target-libdir --target ${POINTRT_RUST_TARGET}
      OUTPUT_VARIABLE libraries OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT EXISTS "${libraries}")
      set(${result} "there is no Rust for ${POINTRT_RUST_TARGET}: rustup target add ${POINTRT_RUST_TARGET}, or Debian's \
libstd-rust-dev-windows" PARENT_SCOPE)
      return()
    endif()
  endif()
  # Downloads the crates now, so that a build without a network reports at once which features it lacks.
  file(SHA256 ${folder}/Cargo.lock lock)
  if(NOT lock STREQUAL "${POINTRT_CRATES_FETCHED}")
    execute_process(COMMAND ${POINTRT_CARGO} fetch --locked --manifest-path ${folder}/Cargo.toml
      OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
      set(${result} "cargo cannot fetch the crates of ${folder}/Cargo.lock" PARENT_SCOPE)
      return()
    endif()
    set(POINTRT_CRATES_FETCHED ${lock} CACHE INTERNAL "Cargo.lock whose crates are here")
  endif()
  set(${result} "" PARENT_SCOPE)
endfunction()

function(pointrt_rust_library target folder)
  set(target_folder ${CMAKE_CURRENT_BINARY_DIR}/rust)
  set(library ${target_folder}/release/lib${target}.a)
  set(for_target "")
  if(POINTRT_RUST_TARGET)
    set(library ${target_folder}/${POINTRT_RUST_TARGET}/release/lib${target}.a)
    set(for_target --target ${POINTRT_RUST_TARGET})
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/rust/*.rs)
  add_custom_command(
    OUTPUT ${library}
    COMMAND ${CMAKE_COMMAND} -E env CARGO_TARGET_DIR=${target_folder} RUSTC=${POINTRT_RUSTC}
      ${POINTRT_CARGO} build --release --locked --quiet ${for_target} --manifest-path ${folder}/Cargo.toml
    DEPENDS ${folder}/Cargo.toml ${folder}/Cargo.lock ${sources}
    COMMENT "Building the crate ${target}"
    VERBATIM)
  add_custom_target(${target}_build DEPENDS ${library})
  find_package(Threads REQUIRED)
  add_library(${target} STATIC IMPORTED GLOBAL)
  set_target_properties(${target} PROPERTIES IMPORTED_LOCATION ${library})
  target_link_libraries(${target} INTERFACE Threads::Threads ${POINTRT_RUST_SYSTEM})
  add_dependencies(${target} ${target}_build)
endfunction()
