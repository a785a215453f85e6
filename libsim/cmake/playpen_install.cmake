# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Install rules: libraries, headers, worlds, the command, and a package that others find with
# find_package(playpen). Nothing installed names the source or build folder, so that the tree can
# be moved or packed.
#
# Components (docs/decisions/package.md):
#   programs, development  what lies at the same place in each layout
#   prefix, prefix_dev     libraries, and what names their folder: for `cmake --install` and the tarball
#   multiarch, multiarch_dev  the same files in Debian's folder for libraries; only packages have them
include(CMakePackageConfigHelpers)
include(playpen_player_names)
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/package/playpenConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)

if(TARGET playpen)
  set_target_properties(playpen PROPERTIES INSTALL_RPATH "\$ORIGIN/${playpen_libraries_from_command}")
  # Whoever builds the command can install the package.
  add_dependencies(playpen playpen_batch)
  foreach(_library IN ITEMS playpen_player playpen_batch_c)
    if(TARGET ${_library})
      add_dependencies(playpen ${_library})
    endif()
  endforeach()
endif()

# playpen_install_libraries(LIBDIR COMPONENT [EXCLUDE_FROM_ALL]): the libraries in a folder, and what
# names that folder: build files and links for clients.
function(playpen_install_libraries libdir component)
  set(runtime COMPONENT ${component} ${ARGN})
  set(development COMPONENT ${component}_dev ${ARGN})
  set(libraries playpen_sim playpen_batch playpen_playerlike)
  # The shared libraries beside static ones. With sanitizers there are none.
  foreach(library IN ITEMS playpen_player playpen_batch_c)
    if(TARGET ${library})
      list(APPEND libraries ${library})
    endif()
  endforeach()
  install(TARGETS ${libraries}
    EXPORT playpen_${component}
    ARCHIVE DESTINATION ${libdir} ${development}
    LIBRARY DESTINATION ${libdir} ${runtime} NAMELINK_COMPONENT ${component}_dev)

  # What pictures and films need, and what `playpen run` preloads.
  set(modules playpen_text playpen_film)
  if(TARGET playpen)
    list(APPEND modules playpen_virtual_time)
  endif()
  install(TARGETS ${modules} LIBRARY DESTINATION "${libdir}/playpen" ${runtime})

  set(package_dir "${libdir}/cmake/playpen")
  install(EXPORT playpen_${component} FILE playpenTargets.cmake NAMESPACE playpen::
    DESTINATION "${package_dir}" ${development})
  configure_package_config_file("${PROJECT_SOURCE_DIR}/libsim/cmake/playpenConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/package/${component}/playpenConfig.cmake"
    INSTALL_DESTINATION "${package_dir}"
    PATH_VARS CMAKE_INSTALL_DATADIR CMAKE_INSTALL_BINDIR)
  install(FILES
    "${PROJECT_BINARY_DIR}/package/${component}/playpenConfig.cmake"
    "${PROJECT_BINARY_DIR}/package/playpenConfigVersion.cmake"
    "${PROJECT_SOURCE_DIR}/libsim/cmake/FindPlaypenBox2D.cmake"
    "${PROJECT_SOURCE_DIR}/libsim/cmake/playpenTesting.cmake"
    DESTINATION "${package_dir}" ${development})
  file(RELATIVE_PATH PC_PREFIX "/prefix/${libdir}/pkgconfig" "/prefix")
  string(REGEX REPLACE "/$" "" PC_PREFIX "${PC_PREFIX}")
  set(PC_LIBDIR "${libdir}")
  configure_file("${PROJECT_SOURCE_DIR}/libsim/cmake/playpen_batch.pc.in"
    "${PROJECT_BINARY_DIR}/package/${component}/playpen_batch.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/package/${component}/playpen_batch.pc"
    DESTINATION "${libdir}/pkgconfig" ${development})
  if(BUILD_SHARED_LIBS OR TARGET playpen_player)
    playpen_install_player_names("${libdir}" ${component}_dev ${ARGN})
  endif()
endfunction()

playpen_install_libraries("${CMAKE_INSTALL_LIBDIR}" prefix)
if(playpen_multiarch_libdir AND NOT playpen_multiarch_libdir STREQUAL CMAKE_INSTALL_LIBDIR)
  playpen_install_libraries("${playpen_multiarch_libdir}" multiarch EXCLUDE_FROM_ALL)
endif()

# Folders, not file sets: CMake has those from 3.23 on, Ubuntu 22.04 has 3.22.
foreach(_dir IN ITEMS "${PROJECT_SOURCE_DIR}/libsim/include" "${PROJECT_SOURCE_DIR}/libplayerlike/include"
    "${PROJECT_BINARY_DIR}/libplayerlike/include")
  install(DIRECTORY "${_dir}/" COMPONENT development
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/playpen"
    FILES_MATCHING PATTERN "*.h")
endforeach()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/worlds/" COMPONENT programs
  DESTINATION "${CMAKE_INSTALL_DATADIR}/playpen/worlds")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" COMPONENT programs DESTINATION "${CMAKE_INSTALL_DOCDIR}")

# `playpen doc` reads the pages. Programs must work without the folder of documentation, which small
# systems leave out, so that one has links only.
set(_playpen_pages "${CMAKE_INSTALL_DATADIR}/playpen")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
  COMPONENT programs DESTINATION "${_playpen_pages}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" COMPONENT programs DESTINATION "${_playpen_pages}"
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/examples" COMPONENT programs
  DESTINATION "${_playpen_pages}/docs" FILES_MATCHING PATTERN "*.c" PATTERN "*.py")
file(RELATIVE_PATH _playpen_pages "/${CMAKE_INSTALL_DOCDIR}" "/${_playpen_pages}")
set(_playpen_links)
foreach(_page IN ITEMS README.md CHANGELOG.md docs)
  list(APPEND _playpen_links "${CMAKE_INSTALL_DOCDIR}/${_page}=${_playpen_pages}/${_page}")
endforeach()
playpen_install_links("${_playpen_links}" programs)

if(TARGET playpen)
  # The programs of window and page are looked for beside the command.
  install(TARGETS playpen playpen-page playpen-view
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  # `playpen run --debug` loads it.
  install(FILES "${PROJECT_SOURCE_DIR}/apps/playpen/playpen_gdb.py" COMPONENT programs
    DESTINATION "${CMAKE_INSTALL_DATADIR}/playpen")
  foreach(_template IN ITEMS par_intro par_planning par_exploration par_traps
      par_exploration_changing par_chase par_localization client test)
    string(REPLACE "par_" "" _name "${_template}")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/apps/${_template}/template/" COMPONENT programs
      DESTINATION "${CMAKE_INSTALL_DATADIR}/playpen/templates/${_name}"
      PATTERN build EXCLUDE PATTERN out EXCLUDE)
  endforeach()
endif()

include(playpen_build_package)
include(playpen_package)
