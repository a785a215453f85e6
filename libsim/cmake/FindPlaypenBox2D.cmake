# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Box2D 2.4 as box2d::box2d: by its own CMake package where it is installed, else by search.
find_package(box2d CONFIG QUIET)
if(NOT TARGET box2d::box2d)
  find_path(PLAYPEN_BOX2D_INCLUDE_DIR box2d/box2d.h)
  find_library(PLAYPEN_BOX2D_LIBRARY box2d)
  mark_as_advanced(PLAYPEN_BOX2D_INCLUDE_DIR PLAYPEN_BOX2D_LIBRARY)
  if(PLAYPEN_BOX2D_INCLUDE_DIR AND PLAYPEN_BOX2D_LIBRARY)
    add_library(box2d::box2d UNKNOWN IMPORTED)
    set_target_properties(box2d::box2d PROPERTIES
      IMPORTED_LOCATION "${PLAYPEN_BOX2D_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${PLAYPEN_BOX2D_INCLUDE_DIR}")
  endif()
endif()
if(TARGET box2d::box2d)
  set(PLAYPEN_BOX2D_TARGET box2d::box2d)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PlaypenBox2D
  REQUIRED_VARS PLAYPEN_BOX2D_TARGET
  REASON_FAILURE_MESSAGE "install libbox2d-dev (2.4)")
