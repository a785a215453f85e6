# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# The targets
#   package    Debian packages and a tarball of what is built, in packages/ of the build folder
#   uninstall  removes what the last `cmake --install` has installed
# docs/decisions/package.md explains the layout.
add_custom_target(uninstall
  COMMAND ${CMAKE_COMMAND} "-DMANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt"
    -P "${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake"
  VERBATIM)

# Packages of a part, or with sanitizers, are of no use.
if(NOT TARGET playpen OR PLAYPEN_SANITIZE OR NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

set(CPACK_PACKAGE_VENDOR "The Playpen authors")
set(PLAYPEN_PACKAGE_CONTACT "The Playpen authors <playpen@example.org>" CACHE STRING
  "Maintainer of the packages: NAME <ADDRESS>")
set(CPACK_PACKAGE_CONTACT "${PLAYPEN_PACKAGE_CONTACT}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_THREADS 0)

# --- Debian: the package playpen is the group runtime, playpen-dev the group dev.

set(CPACK_GENERATOR TGZ)
if(playpen_multiarch_libdir)
  list(APPEND CPACK_GENERATOR DEB)
endif()
set(CPACK_PLAYPEN_DEB_COMPONENTS programs development)
if(playpen_multiarch_libdir STREQUAL CMAKE_INSTALL_LIBDIR)
  list(APPEND CPACK_PLAYPEN_DEB_COMPONENTS prefix prefix_dev)
else()
  list(APPEND CPACK_PLAYPEN_DEB_COMPONENTS multiarch multiarch_dev)
endif()
foreach(_component IN ITEMS programs prefix multiarch)
  string(TOUPPER "${_component}" _component)
  set(CPACK_COMPONENT_${_component}_GROUP runtime)
endforeach()
foreach(_component IN ITEMS development prefix_dev multiarch_dev)
  string(TOUPPER "${_component}" _component)
  set(CPACK_COMPONENT_${_component}_GROUP dev)
endforeach()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SOURCE playpen)

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "2D robot simulator with the Player API embedded")
set(_playpen_description "Playpen simulates robots in a plane, for client programs that use the
interface of Player or CCMorse. A program that is linked with Playpen drives
the robots in its own process, without a server, a network or a display.
")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME playpen)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "${_playpen_description}
This package contains the command playpen, the libraries, the worlds, the tasks
of the course and the documentation ('playpen doc').")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Not by CPack, which warns of modules.
set(_playpen_control "${PROJECT_BINARY_DIR}/package")
file(WRITE "${_playpen_control}/triggers" "activate-noawait ldconfig\n")
file(WRITE "${_playpen_control}/shlibs" "")
set(_playpen_libraries playpen_playerlike playpen_batch)
if(BUILD_SHARED_LIBS)
  list(APPEND _playpen_libraries playpen_sim)
endif()
foreach(_library IN LISTS _playpen_libraries)
  file(APPEND "${_playpen_control}/shlibs" "lib${_library} ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} playpen (= ${PROJECT_VERSION})\n")
endforeach()
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${_playpen_control}/triggers" "${_playpen_control}/shlibs")
# With BUILD_SHARED_LIBS, the command and the libraries need one another.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
  "${PROJECT_BINARY_DIR}/libsim" "${PROJECT_BINARY_DIR}/libplayerlike")
# The font of texts in pictures.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "fonts-dejavu-core, bubblewrap, libarchive-tools")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME playpen-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION "${_playpen_description}
This package contains what such programs are built with: headers, static
libraries, and files for CMake (playpen) and pkg-config (playerc++,
playpen_batch).")
# Those that playpenConfig.cmake finds.
set(_playpen_dev_packages "playpen (= ${PROJECT_VERSION})" libeigen3-dev)
if(NOT BUILD_SHARED_LIBS)
  list(APPEND _playpen_dev_packages libbox2d-dev libjpeg-dev libpng-dev nlohmann-json3-dev libspdlog-dev
    libyaml-cpp-dev zlib1g-dev)
endif()
list(JOIN _playpen_dev_packages ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "g++, cmake, make, pkg-config")
# Player's own packages have files of the same names.
set(CPACK_DEBIAN_DEV_PACKAGE_CONFLICTS "libplayerc++-dev, libplayerc-dev, libplayercore-dev")

# --- What differs between the two kinds, and the target

set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_LIST_DIR}/package_kind.cmake")
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
# Not at the top of the build folder: CMake would add a target `package` that builds all, tests included.
set(CPACK_OUTPUT_CONFIG_FILE "${PROJECT_BINARY_DIR}/package/CPackConfig.cmake")
set(CPACK_SOURCE_OUTPUT_CONFIG_FILE "${PROJECT_BINARY_DIR}/package/CPackSourceConfig.cmake")
include(CPack)
add_custom_target(package
  COMMAND ${CMAKE_COMMAND} -E rm -rf "${CPACK_PACKAGE_DIRECTORY}"
  COMMAND ${CMAKE_CPACK_COMMAND} --config "${CPACK_OUTPUT_CONFIG_FILE}" -C $<CONFIG>
  COMMAND ${CMAKE_COMMAND} -E rm -rf "${CPACK_PACKAGE_DIRECTORY}/_CPack_Packages"
  VERBATIM)
add_dependencies(package playpen)
