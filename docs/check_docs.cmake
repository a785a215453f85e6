# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Runs Doxygen and fails on its warnings; used by the target docs with
#   -DDOXYGEN=... -DDOXYFILE=... -DLOG=...
# The one kind that is let through, and counted only: members of a documented class or struct
# that have no words of their own (Colour::r, Device::name()), and Player's constants, macros whose
# names say all. Whether these need any is for people to judge. Classes, and all that stands in a namespace, must be documented.
cmake_minimum_required(VERSION 3.22)
file(REMOVE "${LOG}")
execute_process(COMMAND "${DOXYGEN}" "${DOXYFILE}" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "doxygen failed (${status})")
endif()
set(lines)
if(EXISTS "${LOG}")
  file(READ "${LOG}" text)
  # Signatures hold characters that mean something in CMake's lists.
  string(REGEX REPLACE "[][;]" "_" text "${text}")
  string(REPLACE "\n" ";" lines "${text}")
  list(REMOVE_ITEM lines "")
  list(REMOVE_DUPLICATES lines)
endif()
set(wordless
  "warning: Member .*( of (class|struct|union) .*| \\(macro definition\\) of file .*) is not documented\\.$")
set(members "${lines}")
list(FILTER members INCLUDE REGEX "${wordless}")
list(LENGTH members member_count)
list(FILTER lines EXCLUDE REGEX "${wordless}")
message(STATUS "${member_count} members of documented classes and macros have no words of their own: ${LOG}")
if(lines)
  list(JOIN lines "\n" text)
  message(FATAL_ERROR "the reference pages have faults:\n${text}")
endif()
