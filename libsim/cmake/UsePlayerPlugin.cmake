# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# Projects of client programs include this beside UsePlayerC++ without using it. Drivers and interfaces
# that are loaded into Player's server have nothing to be loaded into here.
foreach(_playpen_command IN ITEMS PLUGIN_DRIVER PLUGIN_INTERFACE)
  cmake_language(EVAL CODE "
    function(player_add_${_playpen_command} name)
      message(FATAL_ERROR \"PLAYER_ADD_${_playpen_command}(\${name}): Playpen has no player server that \"
        \"could load a plugin; only client programs can be built with it. Leave this call out.\")
    endfunction()")
endforeach()
