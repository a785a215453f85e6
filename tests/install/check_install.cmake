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

# The package is installed anew each time. The projects built against it are kept, so that only
# changed sources are compiled again (installed files keep their times).
file(REMOVE_RECURSE "${STAGE_DIR}/first" "${STAGE_DIR}/moved" "${STAGE_DIR}/my robot/out")
run("installing" ${CMAKE_COMMAND} --install ${BUILD_DIR} --config "${CONFIG}"
  --prefix ${STAGE_DIR}/first)
# The package must be relocatable.
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
    # Compare whole paths: a tree in /playpen must not match share/playpen/worlds.
    string(REGEX REPLACE "([][+.*()^$?|\\\\])" "\\\\\\1" pattern "${folder}")
    if(text MATCHES "(^|[^A-Za-z0-9_}.-])${pattern}(/|[^A-Za-z0-9_.-]|$)")
      message(FATAL_ERROR "${package_file} names the folder ${folder} of this build")
    endif()
  endforeach()
endforeach()

run("configuring the consumer" ${CMAKE_COMMAND}
  -S ${CONSUMER_DIR} -B ${STAGE_DIR}/consumer -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_C_COMPILER=${C_COMPILER}
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
foreach(program IN ITEMS batch_user batch_user_in_c)
  run("running ${program}" ${STAGE_DIR}/consumer/${program})
  if(NOT run_output MATCHES "3 simulations after 0.2 s")
    message(FATAL_ERROR "${program} printed:\n${run_output}")
  endif()
endforeach()
if(EXISTS "${prefix}/bin/playpen")
  run("the installed command" "${prefix}/bin/playpen" --version)
  if(NOT EXISTS "${prefix}/bin/playpen-view")
    message(FATAL_ERROR "playpen-view, the program of the live window, was not installed")
  endif()
  run("the installed program of the live page" "${prefix}/bin/playpen-page" --version)
  # The client's sleeps are simulated time, through a library that is found in a folder with blanks.
  run("running the sleeping client" "${prefix}/bin/playpen" run default
    --out ${STAGE_DIR}/sleeper_out -- ${STAGE_DIR}/consumer/sleeper)
  if(NOT run_output MATCHES "3.5 s simulated")
    message(FATAL_ERROR "the sleeping client's run printed:\n${run_output}")
  endif()
  run("the consumer's tests" ${CMAKE_CTEST_COMMAND} --test-dir ${STAGE_DIR}/consumer --no-tests=error)
  if(NOT EXISTS "${STAGE_DIR}/consumer/playpen/drives_far/seed1/replay.html"
      OR NOT EXISTS "${STAGE_DIR}/consumer/playpen/drives/seed2/report.json")
    message(FATAL_ERROR "the consumer's tests did not write their results:\n${run_output}")
  endif()
endif()

# A task of the course, copied out of the tree, then built and run by the installed command on an
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

# A project with tests of its controller class and of its program, made by the installed command.
if(EXISTS "${prefix}/bin/playpen")
  set(tested "${STAGE_DIR}/tested robot")
  file(REMOVE_RECURSE "${tested}.new")
  run("making a project with tests" "${prefix}/bin/playpen" new test "${tested}.new")
  file(REMOVE_RECURSE "${tested}.new/.vscode")
  file(COPY "${tested}.new/" DESTINATION "${tested}")
  run("configuring the project with tests" ${CMAKE_COMMAND}
    -S ${tested} -B ${tested}/build -G ${GENERATOR}
    -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
  run("building the project with tests" ${CMAKE_COMMAND} --build ${tested}/build --config "${CONFIG}")
  run("the project's tests" ${CMAKE_CTEST_COMMAND} --test-dir ${tested}/build --no-tests=error
    --output-on-failure)
  if(NOT run_output MATCHES "Wanderer\\.LaserDies_Stops" OR NOT run_output MATCHES "robot_in_arena\\.seed3")
    message(FATAL_ERROR "not all tests of the project ran:\n${run_output}")
  endif()
endif()

# Old programs for Player, with their original build files.
find_program(bash bash REQUIRED)
run("building by old build files" ${CMAKE_COMMAND} -E env
  "CXX=${CXX_COMPILER}" "CXXFLAGS=${CXX_FLAGS}" "CC=${C_COMPILER}" "CFLAGS=${CXX_FLAGS}"
  "${bash}" "${CMAKE_CURRENT_LIST_DIR}/old_build_files.sh" "${prefix}" "${STAGE_DIR}/old")
message(STATUS "${run_output}")

# An installed Player keeps its names; a second installation of Playpen finds its own.
set(other "${STAGE_DIR}/other")
file(REMOVE_RECURSE "${other}")
file(GLOB_RECURSE link "${prefix}/libplayerc++.so")
file(RELATIVE_PATH link "${prefix}" "${link}")
file(WRITE "${other}/${link}" "another Player")
foreach(time IN ITEMS first second)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --config "${CONFIG}"
    --prefix ${other} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  file(READ "${other}/${link}" text)
  string(REGEX REPLACE "[ \n]+" " " err "${err}")
  if(NOT status EQUAL 0 OR NOT text STREQUAL "another Player"
      OR NOT err MATCHES "libplayerc\\+\\+\\.so is there already and not Playpen's"
      OR err MATCHES "libplayerc\\.so is there already")
    message(FATAL_ERROR "installing beside another Player, the ${time} time (${status}):\n${err}\n${text}")
  endif()
endforeach()
file(REMOVE_RECURSE "${other}")

if(EXISTS "${prefix}/bin/playpen")
  include("${CMAKE_CURRENT_LIST_DIR}/check_command.cmake")
endif()
