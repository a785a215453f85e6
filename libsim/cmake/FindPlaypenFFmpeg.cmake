# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# The libraries of FFmpeg that encode films, as playpen_ffmpeg. They are needed to build Playpen;
# programs load them with its module for films, when they make one.
include(FindPackageHandleStandardArgs)
set(_playpen_ffmpeg_libraries)
foreach(_library IN ITEMS avformat avcodec avutil)
  find_library(PLAYPEN_${_library}_LIBRARY ${_library})
  mark_as_advanced(PLAYPEN_${_library}_LIBRARY)
  list(APPEND _playpen_ffmpeg_libraries PLAYPEN_${_library}_LIBRARY)
endforeach()
find_path(PLAYPEN_FFMPEG_INCLUDE_DIR libavformat/avformat.h)
mark_as_advanced(PLAYPEN_FFMPEG_INCLUDE_DIR)
find_package_handle_standard_args(PlaypenFFmpeg
  REQUIRED_VARS ${_playpen_ffmpeg_libraries} PLAYPEN_FFMPEG_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install lib{avformat,avcodec}-dev")
if(PlaypenFFmpeg_FOUND AND NOT TARGET playpen_ffmpeg)
  add_library(playpen_ffmpeg INTERFACE IMPORTED)
  target_include_directories(playpen_ffmpeg SYSTEM INTERFACE ${PLAYPEN_FFMPEG_INCLUDE_DIR})
  foreach(_library IN LISTS _playpen_ffmpeg_libraries)
    target_link_libraries(playpen_ffmpeg INTERFACE ${${_library}})
  endforeach()
endif()
