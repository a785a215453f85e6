# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Install rules: libraries, headers, worlds, the command, and a package that others find with
# find_package(playpen). Nothing installed names the source or build folder, so that the tree can
# be moved or packed.
include(CMakePackageConfigHelpers)
set(_playpen_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/playpen")

install(TARGETS playpen_sim playpen_playerlike
  EXPORT playpenTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# What pictures and films need, loaded from beside the library.
install(TARGETS playpen_text playpen_film LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/playpen")
# The shared library beside static ones.
if(TARGET playpen_player)
  install(TARGETS playpen_player
    EXPORT playpenTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  # Whoever builds the command can install the package.
  if(TARGET playpen)
    add_dependencies(playpen playpen_player)
  endif()
endif()

# Folders, not file sets: CMake has those from 3.23 on, Ubuntu 22.04 has 3.22.
foreach(_dir IN ITEMS "${PROJECT_SOURCE_DIR}/libsim/include" "${PROJECT_SOURCE_DIR}/libplayerlike/include"
    "${PROJECT_BINARY_DIR}/libplayerlike/include")
  install(DIRECTORY "${_dir}/"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/playpen"
    FILES_MATCHING PATTERN "*.h")
endforeach()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/worlds/"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/playpen/worlds")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

if(TARGET playpen)
  set_target_properties(playpen PROPERTIES INSTALL_RPATH "\$ORIGIN/${playpen_libraries_from_command}")
  # The window's program is looked for beside the command.
  install(TARGETS playpen playpen-view RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(TARGETS playpen_virtual_time
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/playpen")
endif()

if(TARGET playpen)
  foreach(_template IN ITEMS par_intro par_planning par_exploration par_traps
      par_exploration_changing par_chase par_localization client)
    string(REPLACE "par_" "" _name "${_template}")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/apps/${_template}/template/"
      DESTINATION "${CMAKE_INSTALL_DATADIR}/playpen/templates/${_name}"
      PATTERN build EXCLUDE PATTERN out EXCLUDE)
  endforeach()
endif()

install(EXPORT playpenTargets NAMESPACE playpen:: DESTINATION "${_playpen_package_dir}")
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/playpenConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/package/playpenConfig.cmake"
  INSTALL_DESTINATION "${_playpen_package_dir}"
  PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/package/playpenConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/package/playpenConfig.cmake"
  "${PROJECT_BINARY_DIR}/package/playpenConfigVersion.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindPlaypenBox2D.cmake"
  DESTINATION "${_playpen_package_dir}")
# With sanitizers there is no shared library beside static ones.
if(BUILD_SHARED_LIBS OR TARGET playpen_player)
  include(playpen_player_names)
endif()
include(playpen_build_package)
