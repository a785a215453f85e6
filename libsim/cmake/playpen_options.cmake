# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Flags of our own code, on an interface target, so that none leaks to users of the libraries.
add_library(playpen_build_flags INTERFACE)
target_compile_options(playpen_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  -ffp-contract=off            # the same bits from every compiler, Debug and Release
  # Memory for time: gcc does not look for garbage before its heap has reached half a gigabyte.
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
  $<$<BOOL:${PLAYPEN_WERROR}>:-Werror>)
target_compile_definitions(playpen_build_flags INTERFACE
  $<$<CONFIG:Debug,RelWithDebInfo>:SIM_ENABLE_ASSERTS>)
if(PLAYPEN_SANITIZE)
  target_compile_options(playpen_build_flags INTERFACE
    -fsanitize=${PLAYPEN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    # AddressSanitizer finds the same faults at run time; these two take a sixth of the compile time.
    -fno-sanitize=null,object-size
    # With sanitizers gcc 12 takes std::regex's own variables for uninitialised.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(playpen_build_flags INTERFACE -fsanitize=${PLAYPEN_SANITIZE})
endif()

# From an installed program to the libraries beside it: what is loaded or preloaded lies there.
file(RELATIVE_PATH playpen_libraries_from_command
  "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
# The same binaries are also packaged for Debian, with the libraries in its folder for this kind of
# machine. Programs look in all of these places; this is a list of C++ strings.
set(playpen_library_places "\"${playpen_libraries_from_command}\",\"../lib\"")
set(playpen_multiarch_libdir "")
if(CMAKE_LIBRARY_ARCHITECTURE)
  set(playpen_multiarch_libdir "lib/${CMAKE_LIBRARY_ARCHITECTURE}")
  string(APPEND playpen_library_places ",\"../${playpen_multiarch_libdir}\"")
endif()

# playpen_module(NAME SOURCE...): a library that is loaded at run time from lib/playpen. It is not built
# with sanitizers: it is there before they are, or belongs to a library that has none.
function(playpen_module name)
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES
    CXX_STANDARD 20
    CXX_STANDARD_REQUIRED ON
    CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    POSITION_INDEPENDENT_CODE ON
    LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/playpen")
  target_include_directories(${name} PRIVATE src)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
    $<$<BOOL:${PLAYPEN_WERROR}>:-Werror>)
endfunction()

# playpen_bind_own_functions(TARGET): calls within a shared library go to its own functions, also
# where a program has one of the same name: by chance, or its copy of an inline function of a common
# header, which may be compiled without optimisation.
function(playpen_bind_own_functions target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND UNIX AND NOT APPLE)
    target_link_options(${target} PRIVATE LINKER:-Bsymbolic-functions)
  endif()
endfunction()

# playpen_find_modules_from_programs(TARGET): programs that link the installed static library look for
# the modules that it loads in the installation, wherever they lie themselves. Shared libraries look
# beside themselves.
function(playpen_find_modules_from_programs target)
  if(NOT BUILD_SHARED_LIBS AND UNIX AND NOT APPLE)
    foreach(libdir IN ITEMS ${CMAKE_INSTALL_LIBDIR} ${playpen_multiarch_libdir})
      target_link_options(${target} INTERFACE
        "$<INSTALL_INTERFACE:LINKER:-rpath,$<INSTALL_PREFIX>/${libdir}/playpen>")
    endforeach()
  endif()
endfunction()

# playpen_group_sources(TARGET): with PLAYPEN_UNITY, sources of one folder are
# compiled together, twelve at a time: most of a source's time is spent on the headers of others.
# Those that have properties of their own are compiled alone.
function(playpen_group_sources target)
  if(NOT PLAYPEN_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # Warns of types with members of the anonymous namespace, unless they lie in the main file.
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_source_file_property(own ${source} COMPILE_DEFINITIONS)
    get_source_file_property(own_options ${source} COMPILE_OPTIONS)
    if(own OR own_options OR IS_ABSOLUTE "${source}")
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      continue()
    endif()
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "${folder}" group)
    math(EXPR number "${${group}_count} + 0")
    math(EXPR ${group}_count "${number} + 1")
    math(EXPR part "${number} / 12")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${group}_${part}")
  endforeach()
endfunction()
