# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Run by CPack before it packs the installed files: what Debian's policy wants of them.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
file(GLOB _groups LIST_DIRECTORIES true "${CPACK_TEMPORARY_DIRECTORY}/*")
set(_runtime "${CPACK_TEMPORARY_DIRECTORY}/runtime/usr")
set(_dev "${CPACK_TEMPORARY_DIRECTORY}/dev/usr")
if(NOT EXISTS "${_runtime}/bin/playpen" OR NOT EXISTS "${_dev}/include/playpen")
  message(FATAL_ERROR "the installed files are not where they are expected: ${_groups}")
endif()

# The loader searches the folder of these libraries anyway.
file(GLOB_RECURSE _binaries "${_runtime}/bin/*" "${_runtime}/lib/*.so*")
foreach(_binary IN LISTS _binaries)
  if(NOT IS_SYMLINK "${_binary}")
    file(RPATH_REMOVE FILE "${_binary}")
  endif()
endforeach()

# What gcc leaves in archives for debuggers only.
find_program(_strip strip REQUIRED NO_CACHE)
file(GLOB_RECURSE _archives "${_dev}/lib/*.a")
if(_archives)
  execute_process(COMMAND "${_strip}" --strip-debug --remove-section=.comment --remove-section=.note
      --enable-deterministic-archives ${_archives}
    COMMAND_ERROR_IS_FATAL ANY)
endif()

# compressed(FILE): replaces a file by FILE.gz, without name and time.
find_program(_gzip gzip REQUIRED NO_CACHE)
function(compressed file)
  execute_process(COMMAND "${_gzip}" -9nf "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()
file(GLOB_RECURSE _pages "${_runtime}/share/man/*.[1-9]")
foreach(_page IN LISTS _pages)
  compressed("${_page}")
endforeach()
foreach(_program IN ITEMS playpen-page playpen-view)
  if(NOT EXISTS "${_runtime}/share/man/man1/${_program}.1.gz")
    file(CREATE_LINK playpen.1.gz "${_runtime}/share/man/man1/${_program}.1.gz" SYMBOLIC)
  endif()
endforeach()

set(_doc "${_runtime}/share/doc/playpen")
file(RENAME "${_doc}/LICENSE" "${_doc}/copyright")
string(TIMESTAMP _date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${_doc}/changelog" "playpen (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * CHANGELOG.md lists the changes.

 -- ${CPACK_PACKAGE_CONTACT}  ${_date}
")
compressed("${_doc}/changelog")
file(MAKE_DIRECTORY "${_dev}/share/doc")
file(CREATE_LINK playpen "${_dev}/share/doc/playpen-dev" SYMBOLIC)
