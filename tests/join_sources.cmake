# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Writes one source that holds several others, which the compiler then reads at once: what they
# include is parsed, and the templates that they use are generated, once for all of them.
#
#   cmake -DOUT=FILE -DSOURCES=FILE,FILE,... -P join_sources.cmake
#
# The sources are not changed. In the joined one, the unnamed namespace of each has a name of its
# own, so that equal names of two sources do not meet; messages of the compiler and __FILE__ name the
# original's file and line.
string(REPLACE "," ";" sources "${SOURCES}")
set(joined "// Written by tests/join_sources.cmake; do not edit.\n")
foreach(source IN LISTS sources)
  file(READ "${source}" text)
  get_filename_component(id "${source}" NAME_WE)
  string(MAKE_C_IDENTIFIER "joined_${id}" id)
  string(REPLACE "\nnamespace {\n" "\nnamespace ${id} {\n" text "${text}")
  string(APPEND joined "#line 1 \"${source}\"\n${text}")
endforeach()
file(WRITE "${OUT}" "${joined}")
