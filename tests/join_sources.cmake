# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Writes one source that contains several others, so that the compiler parses their includes, and
# instantiates their templates, only once.
#
#   cmake -DOUT=FILE -DSOURCES=FILE,FILE,... -P join_sources.cmake
#
# The sources are not changed. The definitions in FILE.definitions, in the folder of OUT, are those of
# the source FILE alone. In the joined source, the unnamed namespace of each gets a name of
# its own, so that equal names of two sources do not collide. Compiler messages and __FILE__ name
# the original file and line.
string(REPLACE "," ";" sources "${SOURCES}")
set(joined "// Written by tests/join_sources.cmake; do not edit.\n")
foreach(source IN LISTS sources)
  file(READ "${source}" text)
  get_filename_component(id "${source}" NAME_WE)
  string(MAKE_C_IDENTIFIER "joined_${id}" id)
  string(REPLACE "\nnamespace {\n" "\nnamespace ${id} {\n" text "${text}")
  get_filename_component(folder "${OUT}" DIRECTORY)
  get_filename_component(name "${source}" NAME)
  file(READ "${folder}/${name}.definitions" definitions)
  string(APPEND joined "${definitions}#line 1 \"${source}\"\n${text}")
  string(REGEX REPLACE "#define ([A-Z_]+) [^\n]*" "#undef \\1" ends "${definitions}")
  string(APPEND joined "${ends}")
endforeach()
file(WRITE "${OUT}" "${joined}")
