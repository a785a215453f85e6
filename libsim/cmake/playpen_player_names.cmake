# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# What build files written for Player look for: its libraries' names, its include folders, its .pc files
# and its CMake modules. All of them lead to the one shared library libplaypen_playerlike.so
# (docs/decisions/player_names.md), by paths relative to where they lie, so that the installed tree can be
# moved.

# The libraries that client programs name themselves, or that Player's pkg-config named for them.
set(_playpen_player_libraries playerc++ playerc playercore playerinterface playercommon playererror
  playerjpeg playerwkb playerxdr playerreplace)
# The include folders of the versions that programs name, as in -I/usr/local/include/player-3.0.
set(_playpen_player_versions 2.0 2.1 3.0 3.1)

# playpen_install_links(LINKS COMPONENT [EXCLUDE_FROM_ALL]): installs symbolic links. LINKS is a list of
# LINK=TARGET, where LINK is relative to the prefix.
function(playpen_install_links _playpen_links component)
  set(script "${PROJECT_BINARY_DIR}/package/links_${component}.cmake")
  configure_file("${PROJECT_SOURCE_DIR}/libsim/cmake/install_links.cmake.in" "${script}" @ONLY)
  install(SCRIPT "${script}" COMPONENT ${component} ${ARGN})
endfunction()

# playpen_install_player_names(LIBDIR COMPONENT [EXCLUDE_FROM_ALL]): Player's names for the libraries in
# a folder.
function(playpen_install_player_names CMAKE_INSTALL_LIBDIR component)
  set(templates "${PROJECT_SOURCE_DIR}/libsim/cmake")
  set(made "${PROJECT_BINARY_DIR}/package/${component}")

  # --- Links
  set(_playpen_links)
  foreach(_name IN LISTS _playpen_player_libraries)
    list(APPEND _playpen_links "${CMAKE_INSTALL_LIBDIR}/lib${_name}.so=libplaypen_playerlike.so")
  endforeach()
  foreach(_version IN LISTS _playpen_player_versions)
    list(APPEND _playpen_links "${CMAKE_INSTALL_INCLUDEDIR}/player-${_version}=playpen")
  endforeach()
  playpen_install_links("${_playpen_links}" ${component} ${ARGN})

  # --- pkg-config

  set(_playpen_pc_folder "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
  file(RELATIVE_PATH PC_PREFIX "/prefix/${_playpen_pc_folder}" "/prefix")
  string(REGEX REPLACE "/$" "" PC_PREFIX "${PC_PREFIX}")
  # Programs ask for a version of Player.
  file(STRINGS "${PROJECT_SOURCE_DIR}/libplayerlike/include/playerconfig.h" _playpen_player_version
    REGEX "^#define PLAYER_VERSION ")
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" PC_VERSION "${_playpen_player_version}")
  foreach(PC_NAME IN LISTS _playpen_player_libraries)
    if(PC_NAME STREQUAL "playerc++")
      set(PC_DESCRIPTION "Player's C++ client library, by the simulator Playpen")
    elseif(PC_NAME STREQUAL "playerc")
      set(PC_DESCRIPTION "Player's C client library, by the simulator Playpen")
    else()
      set(PC_DESCRIPTION "What clients use of Player's ${PC_NAME}, by the simulator Playpen")
    endif()
    configure_file("${templates}/player.pc.in"
      "${made}/${PC_NAME}.pc" @ONLY)
    install(FILES "${made}/${PC_NAME}.pc" DESTINATION "${_playpen_pc_folder}"
      COMPONENT ${component} ${ARGN})
  endforeach()

  # --- CMake modules: include(UsePlayerC++) and PLAYER_ADD_PLAYERCPP_CLIENT(), likewise for C

  set(_playpen_module_folder "${CMAKE_INSTALL_DATAROOTDIR}/cmake/Modules")
  file(RELATIVE_PATH USE_PREFIX "/prefix/${_playpen_module_folder}" "/prefix")
  string(REGEX REPLACE "/$" "" USE_PREFIX "${USE_PREFIX}")
  foreach(_module IN ITEMS "UsePlayerC++|playerc++|PLAYERCPP" "UsePlayerC|playerc|PLAYERC")
    string(REPLACE "|" ";" _module "${_module}")
    list(GET _module 0 USE_MODULE)
    list(GET _module 1 USE_LIBRARY)
    list(GET _module 2 USE_NAME)
    string(TOLOWER "${USE_NAME}" USE_FUNCTION)
    configure_file("${templates}/UsePlayer.cmake.in"
      "${made}/${USE_MODULE}.cmake" @ONLY)
    install(FILES "${made}/${USE_MODULE}.cmake"
      DESTINATION "${_playpen_module_folder}" COMPONENT ${component} ${ARGN})
  endforeach()
  install(FILES "${templates}/UsePlayerPlugin.cmake"
    DESTINATION "${_playpen_module_folder}" COMPONENT ${component} ${ARGN})
endfunction()
