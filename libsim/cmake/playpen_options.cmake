# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Flags of our own code, on an interface target, so that none leaks to users of the libraries.
add_library(playpen_build_flags INTERFACE)
target_compile_options(playpen_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  -ffp-contract=off            # the same bits from every compiler, Debug and Release
  $<$<BOOL:${PLAYPEN_WERROR}>:-Werror>)
target_compile_definitions(playpen_build_flags INTERFACE
  $<$<CONFIG:Debug,RelWithDebInfo>:SIM_ENABLE_ASSERTS>)
if(PLAYPEN_SANITIZE)
  target_compile_options(playpen_build_flags INTERFACE
    -fsanitize=${PLAYPEN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    # With sanitizers gcc 12 takes std::regex's own variables for uninitialised.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(playpen_build_flags INTERFACE -fsanitize=${PLAYPEN_SANITIZE})
endif()

# playpen_precompile(TARGET libraries|tests HEADER...): where PLAYPEN_PCH asks for it, the headers of
# other libraries that most of a target's sources include are read once for all of them. A source
# includes what it needs nevertheless: without PLAYPEN_PCH, the default, nobody else does it.
function(playpen_precompile target part)
  if(part IN_LIST PLAYPEN_PCH)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()
if(PLAYPEN_PCH)
  # Memory for time: gcc need not look for garbage, where a precompiled header would have it look at
  # more. And with one, gcc 12 forgets that some warnings are about the standard library's own lines;
  # builds without have them all.
  target_compile_options(playpen_build_flags INTERFACE
    "$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576;-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>")
endif()

# playpen_bind_own_functions(TARGET): calls within a shared library go to its own functions, also
# where a program has one of the same name: by chance, or its copy of an inline function of a common
# header, which may be compiled without optimisation.
function(playpen_bind_own_functions target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND UNIX AND NOT APPLE)
    target_link_options(${target} PRIVATE LINKER:-Bsymbolic-functions)
  endif()
endfunction()
