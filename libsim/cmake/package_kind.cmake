# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Run by CPack for each kind of package: chooses the components (see playpen_install.cmake).
if(CPACK_GENERATOR STREQUAL "DEB")
  # Without dpkg-shlibdeps, CPack would make a package without dependencies.
  foreach(_program IN ITEMS dpkg-shlibdeps file)
    find_program(_playpen_program ${_program} NO_CACHE)
    if(NOT _playpen_program)
      message(FATAL_ERROR "Debian packages need the program ${_program}, which is missing; "
        "apps/install_dependencies.sh package installs it.")
    endif()
    unset(_playpen_program)
  endforeach()
  set(CPACK_COMPONENTS_ALL ${CPACK_PLAYPEN_DEB_COMPONENTS})
  set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
else()
  set(CPACK_COMPONENTS_ALL programs development prefix prefix_dev)
  set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
endif()
