# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# The OpenCV modules Playpen uses, each with what it needs, as playpen_opencv_core, ..._imgproc,
# ..._imgcodecs, ..._videoio and, where it is there, ..._highgui. Debian splits OpenCV; only the huge
# libopencv-dev holds OpenCVConfig.cmake, so its config is used where it is there, else the headers
# and libraries of the small packages are searched for. They are needed to build Playpen; programs
# load them with its modules, when they draw.
set(_playpen_opencv_core_needs)
set(_playpen_opencv_imgproc_needs core)
set(_playpen_opencv_imgcodecs_needs imgproc)
set(_playpen_opencv_videoio_needs imgcodecs)
set(_playpen_opencv_highgui_needs videoio)

if(NOT TARGET playpen_opencv_core)
  find_package(OpenCV 4 CONFIG QUIET)
  if(OpenCV_FOUND)
    set(PLAYPEN_OPENCV_INCLUDE_DIR ${OpenCV_INCLUDE_DIRS})
  else()
    find_path(PLAYPEN_OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
    mark_as_advanced(PLAYPEN_OPENCV_INCLUDE_DIR)
  endif()
  foreach(_module IN ITEMS core imgproc imgcodecs videoio highgui)
    if(TARGET opencv_${_module})
      set(PLAYPEN_OPENCV_${_module}_LIBRARY opencv_${_module})
    else()
      find_library(PLAYPEN_OPENCV_${_module}_LIBRARY opencv_${_module})
      mark_as_advanced(PLAYPEN_OPENCV_${_module}_LIBRARY)
    endif()
    set(_needs ${_playpen_opencv_${_module}_needs})
    if(PLAYPEN_OPENCV_INCLUDE_DIR AND PLAYPEN_OPENCV_${_module}_LIBRARY)
      add_library(playpen_opencv_${_module} INTERFACE IMPORTED)
      target_include_directories(playpen_opencv_${_module} SYSTEM INTERFACE
        ${PLAYPEN_OPENCV_INCLUDE_DIR})
      target_link_libraries(playpen_opencv_${_module} INTERFACE
        "${PLAYPEN_OPENCV_${_module}_LIBRARY}")
      if(_needs)
        target_link_libraries(playpen_opencv_${_module} INTERFACE playpen_opencv_${_needs})
      endif()
    endif()
  endforeach()
endif()
set(PLAYPEN_OPENCV_FOUND TRUE)
foreach(_module IN ITEMS core imgproc imgcodecs videoio)
  if(NOT TARGET playpen_opencv_${_module})
    set(PLAYPEN_OPENCV_FOUND FALSE)
  endif()
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PlaypenOpenCV
  REQUIRED_VARS PLAYPEN_OPENCV_FOUND
  REASON_FAILURE_MESSAGE "install libopencv-{core,imgproc,imgcodecs,videoio}-dev")
