# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# The OpenCV modules Playpen uses, as playpen_opencv. Debian splits OpenCV; only the huge
# libopencv-dev holds OpenCVConfig.cmake, so its config is used where it is there, else the
# headers and libraries of the small packages are searched for.
#
# highgui, which loads a windowing toolkit, is kept out of it: it is playpen_opencv_highgui, where
# it is there.
set(_playpen_opencv_modules core imgproc imgcodecs videoio)
if(NOT TARGET playpen_opencv)
  find_package(OpenCV 4 CONFIG QUIET COMPONENTS ${_playpen_opencv_modules})
  if(OpenCV_FOUND)
    add_library(playpen_opencv INTERFACE IMPORTED)
    target_include_directories(playpen_opencv SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
    target_link_libraries(playpen_opencv INTERFACE ${OpenCV_LIBS})
  else()
    find_path(PLAYPEN_OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
    mark_as_advanced(PLAYPEN_OPENCV_INCLUDE_DIR)
    set(_playpen_opencv_libraries)
    foreach(_module IN LISTS _playpen_opencv_modules)
      find_library(PLAYPEN_OPENCV_${_module}_LIBRARY opencv_${_module})
      mark_as_advanced(PLAYPEN_OPENCV_${_module}_LIBRARY)
      if(NOT PLAYPEN_OPENCV_${_module}_LIBRARY)
        set(_playpen_opencv_missing TRUE)
      endif()
      list(APPEND _playpen_opencv_libraries "${PLAYPEN_OPENCV_${_module}_LIBRARY}")
    endforeach()
    if(PLAYPEN_OPENCV_INCLUDE_DIR AND NOT _playpen_opencv_missing)
      add_library(playpen_opencv INTERFACE IMPORTED)
      target_include_directories(playpen_opencv SYSTEM INTERFACE "${PLAYPEN_OPENCV_INCLUDE_DIR}")
      target_link_libraries(playpen_opencv INTERFACE ${_playpen_opencv_libraries})
    endif()
  endif()
endif()
if(TARGET playpen_opencv)
  set(PLAYPEN_OPENCV_TARGET playpen_opencv)
endif()
if(TARGET playpen_opencv AND NOT TARGET playpen_opencv_highgui)
  find_path(PLAYPEN_OPENCV_HIGHGUI_INCLUDE_DIR opencv2/highgui.hpp PATH_SUFFIXES opencv4)
  find_library(PLAYPEN_OPENCV_highgui_LIBRARY opencv_highgui)
  mark_as_advanced(PLAYPEN_OPENCV_HIGHGUI_INCLUDE_DIR PLAYPEN_OPENCV_highgui_LIBRARY)
  if(PLAYPEN_OPENCV_HIGHGUI_INCLUDE_DIR AND PLAYPEN_OPENCV_highgui_LIBRARY)
    add_library(playpen_opencv_highgui INTERFACE IMPORTED)
    target_include_directories(playpen_opencv_highgui SYSTEM INTERFACE
      "${PLAYPEN_OPENCV_HIGHGUI_INCLUDE_DIR}")
    target_link_libraries(playpen_opencv_highgui INTERFACE
      "${PLAYPEN_OPENCV_highgui_LIBRARY}" playpen_opencv)
  endif()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PlaypenOpenCV
  REQUIRED_VARS PLAYPEN_OPENCV_TARGET
  REASON_FAILURE_MESSAGE "install libopencv-{core,imgproc,imgcodecs,videoio}-dev")
