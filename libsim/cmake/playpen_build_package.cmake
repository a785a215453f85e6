# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# The package playpen of the build folder itself, so that a project which `playpen new` of a clone
# has made builds at once: find_package(playpen HINTS BUILD_FOLDER).
set(_playpen_build_package_dir "${PROJECT_BINARY_DIR}/lib/cmake/playpen")
# Static libraries name all that they link, the targets of the build alone too.
set(_playpen_build_targets playpen_sim playpen_playerlike playpen_build_flags playpen_asio)
if(TARGET playpen_player)
  list(APPEND _playpen_build_targets playpen_player)
endif()
export(TARGETS ${_playpen_build_targets} NAMESPACE playpen::
  FILE "${_playpen_build_package_dir}/playpenTargets.cmake")
# As that of an installation, with the folder of the worlds in the source tree.
file(READ "${CMAKE_CURRENT_LIST_DIR}/playpenConfig.cmake.in" _playpen_config)
string(REPLACE "@PACKAGE_CMAKE_INSTALL_DATADIR@/playpen/worlds" "${PROJECT_SOURCE_DIR}/worlds"
  _playpen_config "${_playpen_config}")
string(REPLACE "@PACKAGE_CMAKE_INSTALL_BINDIR@" "${PROJECT_BINARY_DIR}/bin"
  _playpen_config "${_playpen_config}")
file(WRITE "${PROJECT_BINARY_DIR}/package/playpenBuildConfig.cmake.in" "${_playpen_config}")
configure_package_config_file("${PROJECT_BINARY_DIR}/package/playpenBuildConfig.cmake.in"
  "${_playpen_build_package_dir}/playpenConfig.cmake"
  INSTALL_DESTINATION "${_playpen_build_package_dir}"
  INSTALL_PREFIX "${PROJECT_BINARY_DIR}")
foreach(_file IN ITEMS FindPlaypenBox2D.cmake playpenTesting.cmake)
  configure_file("${CMAKE_CURRENT_LIST_DIR}/${_file}" "${_playpen_build_package_dir}/${_file}"
    COPYONLY)
endforeach()
configure_file("${PROJECT_BINARY_DIR}/package/playpenConfigVersion.cmake"
  "${_playpen_build_package_dir}/playpenConfigVersion.cmake" COPYONLY)
