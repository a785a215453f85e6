// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "sim/core/fields.h"
#include "sim/world/description.h"
#include "sim/world/robot_model.h"
#include "world/controller_fields.h"
#include "world/motion_fields.h"

namespace sim {

SIM_HAS_FIELDS(ObstacleDescription)
SIM_HAS_FIELDS(DockDescription)
SIM_HAS_FIELDS(MapDescription)
SIM_HAS_FIELDS(WallLoop)
SIM_HAS_FIELDS(ArenaDescription)
SIM_HAS_FIELDS(SimulationDescription)
SIM_HAS_FIELDS(CanvasDescription)
SIM_HAS_FIELDS(Elevation)
SIM_HAS_FIELDS(RealRobotDescription)
SIM_HAS_FIELDS(DriverDescription)
SIM_HAS_FIELDS(RobotDescription)
SIM_HAS_FIELDS(WorldDescription)
SIM_HAS_FIELDS(DriveDescription)
SIM_HAS_FIELDS(Superstructure)
SIM_HAS_FIELDS(Polygon)
SIM_HAS_FIELDS(RobotModel)

/// The drives of robots by their "kind" in files; the first is the default. Their value is a
/// DriveDescription.
[[nodiscard]] std::span<const Kind> drive_kinds();

namespace io {

/// @name Formats of fields in world files
/// @{
extern const CustomField kTagsFormat;            ///< a list of names, each once
extern const CustomField kShapeFormat;           ///< a shape and its dimensions
extern const CustomField kStateFormat;           ///< of a dynamic obstacle
extern const CustomField kDynamicFormat;         ///< only for dynamic obstacles
extern const CustomField kMotionFormat;          ///< the kind of motion and its fields
extern const CustomField kFrictionFormat;        ///< only for obstacles that can be pushed
extern const CustomField kBottomFormat;          ///< only for obstacles that stay
extern const CustomField kMapPlaceFormat;        ///< where a picture of walls lies
extern const CustomField kTimeFormat;            ///< "lockstep", "real" or a factor
extern const CustomField kCanvasSizeFormat;      ///< [columns, rows]
extern const CustomField kPortFormat;            ///< a free port
extern const CustomField kRealServerFormat;      ///< where a real robot is
extern const CustomField kRealPoseFormat;        ///< which device tells its pose
extern const CustomField kFootprintFormat;       ///< an outline, or a list of them
extern const CustomField kSuperstructureFormat;  ///< a list of them
extern const CustomField kDriveFormat;           ///< the kind of drive and its fields
extern const CustomField kPresetFormat;          ///< a room that is built in
extern const CustomField kMapsFormat;            ///< a map, or a list of them
extern const CustomField kSeparatorsFormat;      ///< boxes with few keys
extern const CustomField kDevicesFormat;         ///< settings of devices by name
extern const CustomField kModelDevicesFormat;    ///< the same of a model
extern const CustomField kDriverSettingsFormat;  ///< any keys
extern const CustomField kProxiesFormat;         ///< an index for each interface
extern const CustomField kInterfacesFormat;      ///< names of devices for each interface
/// @}

}  // namespace io

}  // namespace sim
