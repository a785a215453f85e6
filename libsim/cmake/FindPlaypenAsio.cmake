# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Standalone Asio, headers only, as playpen_asio. Needed to build Playpen, not to use it.
find_path(PLAYPEN_ASIO_INCLUDE_DIR asio.hpp)
mark_as_advanced(PLAYPEN_ASIO_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PlaypenAsio
  REQUIRED_VARS PLAYPEN_ASIO_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install libasio-dev")
if(PlaypenAsio_FOUND AND NOT TARGET playpen_asio)
  add_library(playpen_asio INTERFACE)
  target_include_directories(playpen_asio SYSTEM INTERFACE "${PLAYPEN_ASIO_INCLUDE_DIR}")
  target_compile_definitions(playpen_asio INTERFACE ASIO_STANDALONE ASIO_NO_DEPRECATED)
endif()
