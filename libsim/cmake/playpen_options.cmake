# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Flags of our own code, on an interface target, so that none leaks to users of the libraries.
add_library(playpen_build_flags INTERFACE)
target_compile_options(playpen_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  -ffp-contract=off            # the same bits from every compiler, Debug and Release
  # Memory for time: gcc does not look for garbage before its heap has reached half a gigabyte.
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
  $<$<BOOL:${PLAYPEN_WERROR}>:-Werror>)
option(PLAYPEN_ASSERTS "Check SIM_ASSERT at run time, in Release builds too" ON)
target_compile_definitions(playpen_build_flags INTERFACE
  $<$<BOOL:${PLAYPEN_ASSERTS}>:SIM_ENABLE_ASSERTS>)
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

# playpen_group_sources(TARGET NAME LEVEL PATTERN[|PATTERN...] ...): with PLAYPEN_UNITY, the sources
# whose path begins with one of the patterns are compiled together, because most of a source's time is
# spent on the headers of others and on the same templates. In Release builds they are optimised at
# LEVEL (-O1, -O2, -O3). A source belongs to the first group that matches. Groups start in their order:
# long ones come first. Sources with definitions or options of their own are compiled alone. If the
# folders of all of a group's sources have a .clang-tidy, the group has the first one.
function(playpen_group_sources target)
  get_target_property(left ${target} SOURCES)
  set(groups "")
  while(ARGN)
    list(POP_FRONT ARGN name level patterns)
    set(includes "")
    set(tidy_files "")
    foreach(source IN LISTS left)
      get_source_file_property(own ${source} COMPILE_DEFINITIONS)
      get_source_file_property(own_options ${source} COMPILE_OPTIONS)
      if(own OR own_options OR IS_ABSOLUTE "${source}" OR NOT source MATCHES "^(${patterns})")
        continue()
      endif()
      list(REMOVE_ITEM left ${source})
      if(PLAYPEN_UNITY)
        string(APPEND includes "#include \"${CMAKE_CURRENT_SOURCE_DIR}/${source}\""
          "  // NOLINT(bugprone-suspicious-include)\n")
        cmake_path(GET source PARENT_PATH folder)
        list(APPEND tidy_files "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/.clang-tidy")
        set_source_files_properties(${source} PROPERTIES HEADER_FILE_ONLY ON)
      else()
        set_source_files_properties(${source} PROPERTIES
          COMPILE_OPTIONS $<$<CONFIG:Release>:${level}>)
      endif()
    endforeach()
    if(PLAYPEN_UNITY)
      set(folder "${CMAKE_CURRENT_BINARY_DIR}/groups/${name}")
      set(group "${folder}/${target}_${name}.cpp")
      set(all_have_one TRUE)
      foreach(file IN LISTS tidy_files)
        if(NOT EXISTS "${file}")
          set(all_have_one FALSE)
        endif()
      endforeach()
      if(all_have_one)
        list(GET tidy_files 0 file)
        configure_file("${file}" "${folder}/.clang-tidy" COPYONLY)
      endif()
      file(CONFIGURE OUTPUT "${group}" CONTENT "${includes}" @ONLY)
      set_source_files_properties(${group} PROPERTIES
        COMPILE_OPTIONS $<$<CONFIG:Release>:${level}>)
      list(APPEND groups "${group}")
    endif()
  endwhile()
  if(PLAYPEN_UNITY)
    get_target_property(sources ${target} SOURCES)
    set_target_properties(${target} PROPERTIES SOURCES "${groups};${sources}")
    # Warns of types with members of the anonymous namespace, unless they lie in the main file.
    target_compile_options(${target} PRIVATE
      $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()
