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

# playpen_join(TARGET [SOURCE...]): where PLAYPEN_JOIN asks for it, a library is compiled a dozen
# sources at once, so that what they include is read, and what they instantiate is made, once for all
# of them. These sources stay alone: names in their unnamed namespaces are also those of others.
function(playpen_join target)
  if("libraries" IN_LIST PLAYPEN_JOIN)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    target_compile_options(${target} PRIVATE -Wno-shadow)  # a local name may be another source's, too
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

# playpen_bind_own_functions(TARGET): calls within a shared library go to its own functions, also
# where a program has one of the same name: by chance, or its copy of an inline function of a common
# header, which may be compiled without optimisation.
function(playpen_bind_own_functions target)
  if(BUILD_SHARED_LIBS AND UNIX AND NOT APPLE)
    target_link_options(${target} PRIVATE LINKER:-Bsymbolic-functions)
  endif()
endfunction()
