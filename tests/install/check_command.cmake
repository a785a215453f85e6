# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Included by check_install.cmake: checks the files that are installed with the command playpen, in
# ${prefix}.
set(command "${prefix}/bin/playpen")
foreach(file IN ITEMS share/man/man1/playpen.1 share/bash-completion/completions/playpen
    share/zsh/site-functions/_playpen share/fish/vendor_completions.d/playpen.fish)
  if(NOT EXISTS "${prefix}/${file}")
    message(FATAL_ERROR "${file} was not installed")
  endif()
  file(SIZE "${prefix}/${file}" size)
  if(size LESS 1000)
    message(FATAL_ERROR "${file} holds ${size} bytes only")
  endif()
endforeach()

# Each template is copied and finds the package at its new place. The templates of the tasks have
# equal CMake files, so a merge configures one of them, and the client.
set(projects "${STAGE_DIR}/new projects")
file(REMOVE_RECURSE "${projects}")
set(kinds intro client)
if(NOT "$ENV{PLAYPEN_NIGHTLY}" STREQUAL "")
  list(APPEND kinds planning exploration traps exploration_changing chase localization)
endif()
foreach(kind IN LISTS kinds)
  run("playpen new ${kind}" "${command}" new ${kind} "${projects}/${kind}")
  if(NOT run_output MATCHES "cmake --build")
    message(FATAL_ERROR "playpen new printed no commands:\n${run_output}")
  endif()
  run("configuring the new ${kind}" ${CMAKE_COMMAND} -S "${projects}/${kind}"
    -B "${projects}/${kind}/build" -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
  file(STRINGS "${projects}/${kind}/build/CMakeCache.txt" found REGEX "^playpen_DIR:PATH=")
  string(FIND "${found}" "${prefix}/" place)
  if(place LESS 0)
    message(FATAL_ERROR "the new ${kind} found another package than that of ${prefix}: ${found}")
  endif()
  file(READ "${projects}/${kind}/.vscode/tasks.json" tasks)
  string(FIND "${tasks}" "\"${command}\"" place)
  if(place LESS 0 OR NOT EXISTS "${projects}/${kind}/build/compile_commands.json")
    message(FATAL_ERROR "an editor cannot run the new ${kind} or has no commands of its compiler:\n${tasks}")
  endif()
endforeach()

# Builds and runs one of them with CMake and with its makefile.
run("building the new client" ${CMAKE_COMMAND} --build "${projects}/client/build")
run("running the new client" "${command}" run cave --duration 5 --out "${projects}/out"
  -- "${projects}/client/build/my_robot")
if(NOT run_output MATCHES "5.0 s simulated")
  message(FATAL_ERROR "the new client's run printed:\n${run_output}")
endif()
file(REMOVE "${projects}/client/build/my_robot")
run("making the new client" make -C "${projects}/client"
  "CXX=${CXX_COMPILER}" "CXXFLAGS=${CXX_FLAGS}")
run("running the new client as made" "${command}" run cave --duration 5 --out "${projects}/out"
  -- "${projects}/client/build/my_robot")
if(NOT run_output MATCHES "5.0 s simulated")
  message(FATAL_ERROR "the run of the client as made printed:\n${run_output}")
endif()

run("playpen list" "${command}" list)
if(NOT run_output MATCHES "\n  cave  ")
  message(FATAL_ERROR "playpen list printed:\n${run_output}")
endif()
run("playpen doctor" ${CMAKE_COMMAND} -E env "CXX=${CXX_COMPILER}" "${command}" doctor)
if(NOT run_output MATCHES "Runs work" OR NOT run_output MATCHES "a client program was configured")
  message(FATAL_ERROR "playpen doctor printed:\n${run_output}")
endif()
