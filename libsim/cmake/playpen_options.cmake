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
