# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Run by the test install.consumer; see CMakeLists.txt beside this file for the variables.
cmake_minimum_required(VERSION 3.22)

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed (${status}):\n${out}\n${err}")
  endif()
  set(run_output "${out}" PARENT_SCOPE)
endfunction()

# The package is installed afresh each time; what is built against it is kept, so that only what
# has changed is compiled again (installed files keep their times).
file(REMOVE_RECURSE "${STAGE_DIR}/first" "${STAGE_DIR}/moved" "${STAGE_DIR}/my robot/out")
run("installing" ${CMAKE_COMMAND} --install ${BUILD_DIR} --config "${CONFIG}"
  --prefix ${STAGE_DIR}/first)
# The package must not care where it lies.
set(prefix "${STAGE_DIR}/moved/to another place")
file(MAKE_DIRECTORY "${STAGE_DIR}/moved")
file(RENAME "${STAGE_DIR}/first" "${prefix}")

file(GLOB_RECURSE package_files "${prefix}/*.cmake")
if(NOT package_files)
  message(FATAL_ERROR "no CMake package was installed")
endif()
foreach(package_file IN LISTS package_files)
  file(READ "${package_file}" text)
  foreach(folder IN ITEMS "${SOURCE_DIR}" "${BUILD_DIR}" "${STAGE_DIR}")
    # As a path of its own: a tree in /playpen must not take share/playpen/worlds for itself.
    string(REGEX REPLACE "([][+.*()^$?|\\\\])" "\\\\\\1" pattern "${folder}")
    if(text MATCHES "(^|[^A-Za-z0-9_}.-])${pattern}(/|[^A-Za-z0-9_.-]|$)")
      message(FATAL_ERROR "${package_file} names the folder ${folder} of this build")
    endif()
  endforeach()
endforeach()

run("configuring the consumer" ${CMAKE_COMMAND}
  -S ${CONSUMER_DIR} -B ${STAGE_DIR}/consumer -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
  "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
  "-DCMAKE_PREFIX_PATH=${prefix}")
run("building the consumer" ${CMAKE_COMMAND} --build ${STAGE_DIR}/consumer --config "${CONFIG}")

run("running the client" ${STAGE_DIR}/consumer/client)
if(NOT run_output MATCHES "read 10 times, robot at -?[0-9.]+ -?[0-9.]+ -?[0-9.]+")
  message(FATAL_ERROR "the client printed no pose:\n${run_output}")
endif()
run("running the simulator's user" ${STAGE_DIR}/consumer/simulator_user)
if(NOT run_output MATCHES "after 1 s: 100 steps")
  message(FATAL_ERROR "the simulator's user printed:\n${run_output}")
endif()
if(EXISTS "${prefix}/bin/playpen")
  run("the installed command" "${prefix}/bin/playpen" --version)
  if(NOT EXISTS "${prefix}/bin/playpen-view")
    message(FATAL_ERROR "playpen-view, the program of the live window, was not installed")
  endif()
  # Its sleeps are simulated time, by a library that is found in a folder with blanks.
  run("running the sleeping client" "${prefix}/bin/playpen" run default
    --out ${STAGE_DIR}/sleeper_out -- ${STAGE_DIR}/consumer/sleeper)
  if(NOT run_output MATCHES "3.5 s simulated")
    message(FATAL_ERROR "the sleeping client's run printed:\n${run_output}")
  endif()
endif()

# A task of the course, copied out of the tree, built and run by the installed command on an
# installed world.
set(task "${STAGE_DIR}/my robot")
file(COPY "${SOURCE_DIR}/apps/par_intro/solution_wall/" DESTINATION "${task}")
run("configuring the copied task" ${CMAKE_COMMAND}
  -S ${task} -B ${task}/build -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
  "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
  "-DCMAKE_PREFIX_PATH=${prefix}")
run("building the copied task" ${CMAKE_COMMAND} --build ${task}/build --config "${CONFIG}")
if(EXISTS "${prefix}/bin/playpen")
  run("running the copied task" "${prefix}/bin/playpen" run tasks/par_intro
    --duration 5 --out ${task}/out -- ${task}/build/par_intro_solution_wall)
  if(NOT run_output MATCHES "5.0 s simulated" OR NOT EXISTS "${task}/out/report.json")
    message(FATAL_ERROR "the copied task's run printed:\n${run_output}")
  endif()
endif()

# Programs as old as Player: one command with what pkg-config says, no build system, and nothing set
# when they run. Through a name without spaces, since a shell splits at them what stands for a
# command's output; and as makefiles do, where the flags become part of a line and may hold spaces.
set(old "${STAGE_DIR}/old")
file(REMOVE_RECURSE "${old}")
file(COPY "${CONSUMER_DIR}/../old/" DESTINATION "${old}")
file(GLOB_RECURSE pc_files "${prefix}/*.pc")
list(LENGTH pc_files pc_count)
if(NOT pc_count EQUAL 2)
  message(FATAL_ERROR "these were installed for pkg-config, not playerc++.pc and playerc.pc: ${pc_files}")
endif()
foreach(pc_file IN LISTS pc_files)
  file(READ "${pc_file}" text)
  if(text MATCHES "=/")
    message(FATAL_ERROR "${pc_file} names a folder of this machine:\n${text}")
  endif()
endforeach()
list(GET pc_files 0 pc_file)
get_filename_component(pc_folder "${pc_file}" DIRECTORY)
file(RELATIVE_PATH pc_below "${prefix}" "${pc_folder}")
file(CREATE_LINK "${prefix}" "${old}/here" SYMBOLIC)

# run_old(COMPILER SOURCE PACKAGE PATTERN): compiles a source both ways, and runs it.
function(run_old compiler source package pattern)
  set(flags "pkg-config --cflags --libs ${package}")
  # From its own folder, by a relative name: the build may lie below one with a space.
  run("compiling ${source}" ${CMAKE_COMMAND} -E chdir "${old}"
    ${CMAKE_COMMAND} -E env "PKG_CONFIG_PATH=here/${pc_below}"
    sh -c "'${compiler}' ${CXX_FLAGS} ${source} $(${flags}) -o ${source}_plain")
  run("running ${source}" ${CMAKE_COMMAND} -E chdir "${old}" "./${source}_plain")
  if(NOT run_output MATCHES "${pattern}")
    message(FATAL_ERROR "${source} printed:\n${run_output}")
  endif()
  file(WRITE "${old}/Makefile" "FLAGS = $(shell ${flags})\n\
${source}_made: ${source}\n\t\"${compiler}\" ${CXX_FLAGS} ${source} $(FLAGS) -o $@\n")
  run("making ${source}" ${CMAKE_COMMAND} -E env "PKG_CONFIG_PATH=${pc_folder}"
    make -C "${old}" ${source}_made)
  run("running ${source} as made" "${old}/${source}_made" localhost)
  if(NOT run_output MATCHES "${pattern}")
    message(FATAL_ERROR "${source}, made, printed:\n${run_output}")
  endif()
endfunction()
run_old("${CXX_COMPILER}" wander.cc playerc++ "saw 682 beams, drove to [0-9.]+ [0-9.]+")
run_old("${CXX_COMPILER}" example.cc playerc++ "read for a second at localhost:6665")
run_old("${CXX_COMPILER}" flat.cc playerc++ "laser:0 .*position2d:0 ")
run_old("${C_COMPILER}" wander.c playerc "drove to [0-9.]+ [0-9.]+")

if(EXISTS "${prefix}/bin/playpen")
  include("${CMAKE_CURRENT_LIST_DIR}/check_command.cmake")
endif()
