# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Run by the test install.uninstall: SCRIPT, in FOLDER, on lists of files that are written here.
cmake_minimum_required(VERSION 3.22)

# uninstall(MANIFEST STATUS PATTERN): the script must end with that status and say that.
function(uninstall manifest expected pattern)
  execute_process(COMMAND ${CMAKE_COMMAND} "-DMANIFEST=${manifest}" -P "${SCRIPT}"
    RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  string(REGEX REPLACE "[ \n]+" " " text "${out}${err}")
  if(NOT status EQUAL expected OR NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "status ${status} instead of ${expected}, or no '${pattern}':\n${text}")
  endif()
endfunction()

# check(EXISTS|GONE PATH...)
function(check state)
  foreach(path IN LISTS ARGN)
    if((state STREQUAL "EXISTS" AND NOT EXISTS "${path}") OR
       (state STREQUAL "GONE" AND (EXISTS "${path}" OR IS_SYMLINK "${path}")))
      message(FATAL_ERROR "${path} should be: ${state}")
    endif()
  endforeach()
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
uninstall("${FOLDER}/install_manifest.txt" 1 "Nothing is installed from this build folder")
file(WRITE "${FOLDER}/other.txt" "${FOLDER}/other.txt")
uninstall("${FOLDER}/other.txt" 1 "does not list the files of an installed Playpen")
check(EXISTS "${FOLDER}/other.txt")

set(files bin/playpen lib/libplaypen_sim.a share/man/man1/playpen.1 share/playpen/worlds/syrotek.json
  share/playpen/worlds/tasks/a.json)
# install(PREFIX): writes these files, links and their list.
function(install prefix)
  set(list)
  foreach(file IN LISTS files)
    file(WRITE "$ENV{DESTDIR}${prefix}/${file}" "")
    list(APPEND list "${prefix}/${file}")
  endforeach()
  foreach(link IN ITEMS "include/player-3.0=playpen" "lib/libplayerc.so=nowhere.so")
    string(REPLACE "=" ";" link "${link}")
    list(GET link 0 name)
    list(GET link 1 target)
    file(MAKE_DIRECTORY "$ENV{DESTDIR}${prefix}/include")
    file(CREATE_LINK "${target}" "$ENV{DESTDIR}${prefix}/${name}" SYMBOLIC)
    list(APPEND list "${prefix}/${name}")
  endforeach()
  list(JOIN list "\n" list)
  file(WRITE "${FOLDER}/install_manifest.txt" "${list}")
endfunction()

# A prefix of its own, with characters that mean something in patterns, vanishes.
set(prefix "${FOLDER}/c++ (1)/playpen")
install("${prefix}")
uninstall("${FOLDER}/install_manifest.txt" 0 "Removed 7 files of Playpen from ${FOLDER}/c..")
check(GONE "${prefix}" "${FOLDER}/install_manifest.txt")
check(EXISTS "${FOLDER}/c++ (1)")
# The list is used up.
uninstall("${FOLDER}/install_manifest.txt" 1 "Nothing is installed")

# Files of others stay, and a file that is missing already is no error.
install("${prefix}")
file(WRITE "${prefix}/bin/mine" "")
file(WRITE "${prefix}/share/playpen/worlds/mine.json" "")
file(REMOVE "${prefix}/lib/libplaypen_sim.a")
uninstall("${FOLDER}/install_manifest.txt" 0 "Already gone: .*libplaypen_sim.a.*Removed 6 files")
check(EXISTS "${prefix}/bin/mine" "${prefix}/share/playpen/worlds/mine.json")
check(GONE "${prefix}/bin/playpen" "${prefix}/lib" "${prefix}/include"
  "${prefix}/share/playpen/worlds/tasks" "${prefix}/share/man")

# Of /usr/local only the folders that are named after Playpen vanish.
set(ENV{DESTDIR} "${FOLDER}/root")
install("/usr/local")
uninstall("${FOLDER}/install_manifest.txt" 0 "Removed 7 files")
check(GONE "${FOLDER}/root/usr/local/bin/playpen" "${FOLDER}/root/usr/local/share/playpen"
  "${FOLDER}/root/usr/local/include/player-3.0")
check(EXISTS "${FOLDER}/root/usr/local/bin" "${FOLDER}/root/usr/local/share/man/man1")
