// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The fields of the arena controller's description.
#include "world/controller_fields.h"

#include "sim/world/controller.h"
#include "sim/world/limits.h"

namespace sim {
namespace {

constexpr std::size_t kMostParts = 100;  // conditions, actions, corners
constexpr std::size_t kMostNames = 10'000;

constexpr const char* kBlockedWords[] = {"refuse", "wait"};

/// A point of the floor [m].
template <auto kMember>
[[nodiscard]] constexpr Field place_field(const char* name, const char* meaning) {
  return field<kMember>(name, "m", meaning).within(-kFarthest_m, kFarthest_m);
}
[[nodiscard]] constexpr Field place_key(const char* name, const char* meaning) {
  return key_of_files<Vec2>(name, "m", meaning).within(-kFarthest_m, kFarthest_m);
}
template <auto kMember>
[[nodiscard]] constexpr Field extent_field(const char* name, const char* meaning) {
  return field<kMember>(name, "m", meaning).above(0.0, kGreatestLength_m);
}
template <auto kMember>
[[nodiscard]] constexpr Field time_field(const char* name, const char* meaning) {
  return field<kMember>(name, "s", meaning).within(0.0, kLongestArenaTime_s);
}
template <auto kMember>
[[nodiscard]] constexpr Field names_field(const char* name, const char* meaning) {
  return field<kMember>(name, "", meaning).counting(0, kMostNames);
}
/// Names of dynamic obstacles.
template <auto kMember>
[[nodiscard]] constexpr Field blocks_field(const char* name, const char* meaning) {
  return names_field<kMember>(name, meaning).naming(NamedPart::kDynamicObstacle);
}
/// Names of timers and traps.
template <auto kMember>
[[nodiscard]] constexpr Field switches_field(const char* name, const char* meaning) {
  return names_field<kMember>(name, meaning).naming(NamedPart::kSwitch);
}
/// A text for people.
template <auto kMember>
[[nodiscard]] constexpr Field message_field(const char* name, const char* meaning) {
  return field<kMember>(name, "", meaning).counting(0, kMaxArenaText);
}
/// The robot of a condition or an action.
template <auto kMember>
[[nodiscard]] constexpr Field robot_field() {
  return field<kMember>("robot", "", "name of a robot; a timer has to name one")
      .defaults_to("the one that sprang the trap")
      .naming(NamedPart::kRobot);
}

// --- Conditions

constexpr Field kTimeFields[] = {
    time_field<&TimeCondition::from_s>("from", "since the start or the last reset, included"),
    time_field<&TimeCondition::to_s>("to", "excluded").defaults_to("no end"),
};
constexpr Field kCountFields[] = {
    field<&CountCondition::of>("of", "", "name of a timer or trap")
        .needed("the name of a timer or trap")
        .naming(NamedPart::kSwitch),
    field<&CountCondition::limits, &ArenaLimits::at_least>("at_least", "", "lower limit, included")
        .within(0.0, 1e9)
        .defaults_to("no limit"),
    field<&CountCondition::limits, &ArenaLimits::at_most>("at_most", "", "upper limit, included")
        .within(0.0, 1e9)
        .defaults_to("no limit"),
};
constexpr const char* kPhases[] = {"extended", "retracted", "rising", "sinking"};
constexpr Field kBlockFields[] = {
    field<&BlockCondition::block>("name", "", "name of a dynamic obstacle")
        .needed("the name of a dynamic obstacle")
        .naming(NamedPart::kDynamicObstacle),
    field<&BlockCondition::phase>("state", "", "what it does").one_of(kPhases),
};
constexpr Field kFiducialFields[] = {
    robot_field<&FiducialCondition::robot>(),
    field<&FiducialCondition::number>("number", "", "the number that it must see")
        .within(1, std::numeric_limits<std::int32_t>::max())
        .needed("the number of a robot or an obstacle"),
};

/// The fields of a robot's number between two limits.
[[nodiscard]] constexpr std::array<Field, 3> quantity_fields(double min, double max,
                                                             const char* unit = "") {
  using Condition = QuantityCondition;
  return {
      robot_field<&Condition::robot>(),
      field<&Condition::limits, &ArenaLimits::at_least>("at_least", unit, "lower limit, included")
          .within(min, max)
          .defaults_to("no limit"),
      field<&Condition::limits, &ArenaLimits::at_most>("at_most", unit, "upper limit, included")
          .within(min, max)
          .defaults_to("no limit")};
}
constexpr auto kCollisionsFields = quantity_fields(0.0, 1e9);
constexpr auto kSpeedFields = quantity_fields(0.0, 1e9, "m/s");
constexpr auto kBatteryFields = quantity_fields(0.0, 100.0, "%");
constexpr auto kScoreFields = quantity_fields(-1e9, 1e9);

template <RobotQuantity kQuantity, const auto& kFields>
[[nodiscard]] constexpr Kind quantity_kind(const char* word, const char* meaning) {
  return kind<ArenaCondition, &QuantityCondition::quantity, kQuantity, kFields>(word, meaning);
}

constexpr Kind kConditionKinds[] = {
    kind<ArenaCondition, TimeCondition, kTimeFields>("time", "the simulated time"),
    kind<ArenaCondition, CountCondition, kCountFields>("count",
                                                       "how often a timer or trap has acted"),
    kind<ArenaCondition, BlockCondition, kBlockFields>("block", "what a dynamic obstacle does"),
    quantity_kind<RobotQuantity::kCollisions, kCollisionsFields>(
        "collisions", "how many contacts of a robot have begun"),
    quantity_kind<RobotQuantity::kSpeed, kSpeedFields>("speed", "how fast a robot is"),
    quantity_kind<RobotQuantity::kBattery, kBatteryFields>(
        "battery", "the charge that a robot's battery device has reported last"),
    quantity_kind<RobotQuantity::kScore, kScoreFields>("score", "the points of a robot"),
    kind<ArenaCondition, FiducialCondition, kFiducialFields>("fiducial",
                                                             "what a robot's fiducial device sees"),
};

// --- Actions

constexpr Field kConfigurationAction[] = {
    field<&ConfigurationAction::configuration>("configuration", "",
                                               "name of a configuration that the arena changes to")
        .naming(NamedPart::kConfiguration)};
constexpr Field kExtendAction[] = {
    blocks_field<&BlocksAction::blocks>("extend", "names of dynamic obstacles to be extended")};
constexpr Field kRetractAction[] = {
    blocks_field<&BlocksAction::blocks>("retract", "names of dynamic obstacles to be retracted")};
constexpr Field kToggleAction[] = {blocks_field<&BlocksAction::blocks>(
    "toggle", "names of dynamic obstacles to be extended or retracted, whatever they are not")};
constexpr Field kPlaceAction[] = {
    field<&PlaceAction::obstacle>("obstacle", "", "name of an obstacle")
        .needed("the name of an obstacle")
        .naming(NamedPart::kObstacle),
    field<&PlaceAction::pose>("pose", "m, degrees", "where its middle is, and its turn")
        .needed("{\"x\", \"y\", \"yaw_deg\"} of its middle"),
};
constexpr Field kMessageAction[] = {message_field<&MessageAction::text>(
    "message", "an event with this text, for clients and the report")};
constexpr Field kTextAction[] = {
    message_field<&TextAction::text>("text", "what is shown; \"\" removes the text at this place")
        .needed("what is shown"),
    place_field<&TextAction::place>("place", "its middle; it replaces an earlier text there")
        .defaults_to("the middle of the floor"),
    time_field<&TextAction::duration_s>("duration", "how long it is shown; 0: until the end"),
    field<&TextAction::colour>("colour", "", "of the letters"),
};
constexpr Field kCanvasArea[] = {
    place_field<&CanvasAction::Area::center>(
        "center", "middle of a rectangle; left out together with `size`: the whole canvas")
        .needed("[x, y] of the middle of the rectangle, in m"),
    extent_field<&CanvasAction::Area::size>("size", "sides of the rectangle along x and y")
        .needed("[x, y]: the sides of the rectangle, in m"),
};
constexpr Field kCanvasAction[] = {
    field<&CanvasAction::colour>("colour", "", "of the cells")
        .defaults_to("the cells become transparent"),
    field<&CanvasAction::area>(""),
};
constexpr Field kRestartAction[] = {
    robot_field<&RestartAction::robot>(),
    field<&RestartAction::when_blocked>(
        "when_blocked", "",
        "what is done if the place is taken: nothing, or the same once it is free; events tell "
        "both")
        .one_of(kBlockedWords),
};
constexpr Field kScoreAction[] = {
    robot_field<&ScoreAction::robot>(),
    field<&ScoreAction::points>("points", "", "may be negative").within(-1e6, 1e6),
};
constexpr Field kEnableAction[] = {
    switches_field<&SwitchAction::names>("enable", "names of timers and traps to be switched on")};
constexpr Field kDisableAction[] = {switches_field<&SwitchAction::names>(
    "disable", "names of timers and traps to be switched off")};
constexpr const char* kVerdicts[] = {"passed", "failed"};
constexpr Field kEndAction[] = {
    field<&EndAction::passed>("verdict", "", "the result of the run")
        .one_of(kVerdicts, true)
        .needed("\"passed\" or \"failed\""),
    message_field<&EndAction::reason>("reason", "for people"),
};
constexpr Field kMoveAction[] = {
    field<&MoveAction::obstacle>("obstacle", "",
                                 "name of an obstacle that is neither dynamic nor portable")
        .needed("the name of an obstacle")
        .naming(NamedPart::kObstacle),
    field<&MoveAction::motion>("motion", "", "has keys among those of the action")
        .in_format(io::kMoveFormat),
};

constexpr const char* kFaults[] = {"dead", "blind", "jump", "none"};
constexpr Field kFaultAction[] = {
    robot_field<&FaultAction::robot>(),
    field<&FaultAction::device>("device", "", "name of one of its devices")
        .needed("the name of a device of the robot"),
    field<&FaultAction::kind>(
        "kind", "",
        "dead: it is switched off; blind: a laser, sonar or infrared ranger reads its maximum "
        "everywhere; jump: the pose of an odometry or pose device changes at once; none: it is "
        "repaired")
        .one_of(kFaults),
    field<&FaultAction::by>("by", "m, degrees", "of a jump, in the frame of the robot"),
};

template <BlocksAction::Change kChange, const auto& kFields>
[[nodiscard]] constexpr Kind blocks_kind(const char* word) {
  return kind<ArenaAction, &BlocksAction::change, kChange, kFields>(word, "").bare();
}

constexpr Kind kActionKinds[] = {
    kind<ArenaAction, ConfigurationAction, kConfigurationAction>("configuration", "").bare(),
    blocks_kind<BlocksAction::Change::kExtend, kExtendAction>("extend"),
    blocks_kind<BlocksAction::Change::kRetract, kRetractAction>("retract"),
    blocks_kind<BlocksAction::Change::kToggle, kToggleAction>("toggle"),
    kind<ArenaAction, PlaceAction, kPlaceAction>("place", "places an obstacle"),
    kind<ArenaAction, MessageAction, kMessageAction>("message", "").bare(),
    kind<ArenaAction, TextAction, kTextAction>("text", "shows a text on the scene"),
    kind<ArenaAction, CanvasAction, kCanvasAction>("canvas",
                                                   "changes the grid-map that robots draw on"),
    kind<ArenaAction, RestartAction, kRestartAction>("restart", "puts a robot back to its start"),
    kind<ArenaAction, ScoreAction, kScoreAction>("score", "gives points to a robot"),
    kind<ArenaAction, &SwitchAction::on, true, kEnableAction>("enable", "").bare(),
    kind<ArenaAction, &SwitchAction::on, false, kDisableAction>("disable", "").bare(),
    kind<ArenaAction, EndAction, kEndAction>("end", "ends the run"),
    kind<ArenaAction, MoveAction, kMoveAction>("move", "moves or turns an obstacle"),
    kind<ArenaAction, FaultAction, kFaultAction>("fault", "gives a device a fault"),
};

// --- Configurations, timers and traps

constexpr const char* kOthers[] = {"keep", "extended", "retracted"};
constexpr Field kPlaceFields[] = {
    field<&ArenaPlace::obstacle>("name").as_read_only(),
    field<&ArenaPlace::pose>(""),
};
constexpr Field kConfigurationFields[] = {
    field<&ArenaConfiguration::name>("name").as_name().as_read_only(),
    blocks_field<&ArenaConfiguration::extended>("extended",
                                                "names of dynamic obstacles that are extended"),
    blocks_field<&ArenaConfiguration::retracted>("retracted",
                                                 "names of dynamic obstacles that are retracted"),
    field<&ArenaConfiguration::others>("others", "", "what happens to the other dynamic obstacles")
        .one_of(kOthers),
    field<&ArenaConfiguration::places>("poses", "m, degrees", "where obstacles stand, by name")
        .keyed(),
};

template <auto kMember>
[[nodiscard]] constexpr Field conditions_field(const char* meaning) {
  return field<kMember>("if", "", meaning)
      .counting(0, kMostParts)
      .of_kinds(kConditionKinds, "a condition");
}
template <auto kMember>
[[nodiscard]] constexpr Field actions_field() {
  return field<kMember>("do", "", "what it does, in this order")
      .counting(0, kMostParts)
      .of_kinds(kActionKinds, "an action");
}

constexpr Field kTimerFields[] = {
    field<&TimerDescription::name>("name", "", "unique among timers and traps")
        .as_name()
        .defaults_to("the first free of timer1, timer2, ..."),
    field<&TimerDescription::every_s>("every", "s", "period of further times")
        .within(kLeastArenaPeriod_s, kLongestArenaTime_s)
        .defaults_to("it acts once"),
    time_field<&TimerDescription::at_s>("at",
                                        "first time, counted from when the timer is switched on")
        .defaults_to("`every` if it is given, otherwise 0")
        .in_format(io::kFirstTimeFormat),
    time_field<&TimerDescription::within_s>(
        "within",
        "[from, to]: the first time is random between these times, by the seed; not with `at`")
        .in_format(io::kRandomTimeFormat),
    field<&TimerDescription::times>("times", "", "it is switched off after having acted so often")
        .within(1, 1e9)
        .defaults_to("no limit"),
    time_field<&TimerDescription::jitter_s>(
        "jitter",
        "each time is moved by a random number from -jitter to jitter, by the seed; at most half "
        "of `every`"),
    field<&TimerDescription::enabled>("enabled", "", "whether it is on at the start"),
    conditions_field<&TimerDescription::conditions>(
        "it acts only if all these hold when it is time"),
    actions_field<&TimerDescription::actions>(),
};

constexpr Field kBoxFields[] = {
    place_field<&BoxRegion::center>("center", "its middle in the world")
        .needed("[x, y] of its middle, in m"),
    extent_field<&BoxRegion::size>("size", "length along its own axes"),
    field<&BoxRegion::yaw_rad>("yaw_deg", "degrees", "turn of its axes, counter-clockwise")
        .within(-3600.0, 3600.0),
};
constexpr Field kCircleFields[] = {
    place_field<&CircleRegion::center>("center", "its middle in the world")
        .needed("[x, y] of its middle, in m"),
    extent_field<&CircleRegion::radius_m>("radius", "its radius"),
};
constexpr Field kPolygonFields[] = {
    place_field<&PolygonRegion::corners>("polygon", "corners [x, y] of any polygon")
        .counting(3, kMostParts)
        .expecting("at least 3 corners")
        .needed("a list of corners [x, y], in m")};
constexpr Field kNearFields[] = {
    extent_field<&NearRegion::distance_m>("distance", "how far from the middle"),
    field<&NearRegion::object>("object", "",
                               "name of a robot or an obstacle; the trap moves with its middle")
        .defaults_to("there has to be a `place`"),
    place_key("place", "[x, y] of the middle").in_format(io::kNearPlaceFormat),
};
constexpr Kind kRegionKinds[] = {
    kind<TrapRegion, BoxRegion, kBoxFields>("box", "a rectangle"),
    kind<TrapRegion, CircleRegion, kCircleFields>("circle", "a circle"),
    kind<TrapRegion, PolygonRegion, kPolygonFields>("polygon", "").bare(),
    kind<TrapRegion, NearRegion, kNearFields>(
        "near", "the surroundings of a robot, an obstacle or a place; either this or `region`")
        .beside(),
};

constexpr const char* kTrapEvents[] = {"enter", "leave", "stay"};
constexpr Field kTrapFields[] = {
    field<&TrapDescription::name>("name", "", "unique among timers and traps")
        .as_name()
        .defaults_to("the first free of trap1, trap2, ..."),
    field<&TrapDescription::region>("region", "", "a part of the floor; either this or `near`")
        .defaults_to("there has to be `near`")
        .of_kinds(kRegionKinds, "a region")
        .in_format(io::kTrapRegionFormat),
    names_field<&TrapDescription::robots>("robots",
                                          "names of the robots that it is for, or `\"any\"`")
        .defaults_to("`\"any\"`")
        .in_format(io::kTrapRobotsFormat),
    field<&TrapDescription::model>("model", "", "only for robots of this model")
        .defaults_to("for any"),
    field<&TrapDescription::on>(
        "on", "",
        "when it springs: a robot's middle comes in, goes out, or has been inside for some time")
        .one_of(kTrapEvents),
    time_field<&TrapDescription::stay_s>(
        "for", "how long a robot must have been inside; only with `\"on\": \"stay\"`")
        .in_format(io::kTrapStayFormat),
    field<&TrapDescription::once>("once", "", "whether it is switched off after having sprung"),
    field<&TrapDescription::enabled>("enabled", "", "whether it is on at the start"),
    conditions_field<&TrapDescription::conditions>("it springs only if all these hold"),
    actions_field<&TrapDescription::actions>(),
};

constexpr Field kControllerFields[] = {
    field<&ControllerDescription::configurations>(
        "configurations", "", "named arrangements of dynamic obstacles, by name")
        .counting(0, 1000)
        .keyed(),
    field<&ControllerDescription::timers>("timers", "", "what happens at certain times")
        .counting(0, 1000),
    field<&ControllerDescription::traps>("traps", "",
                                         "what happens when robots are at certain places")
        .counting(0, 10'000),
};

}  // namespace

SIM_FIELDS(CanvasAction::Area, kCanvasArea)
SIM_FIELDS(ArenaPlace, kPlaceFields)
SIM_FIELDS(ArenaConfiguration, kConfigurationFields)
SIM_FIELDS(TimerDescription, kTimerFields)
SIM_FIELDS(TrapDescription, kTrapFields)
SIM_FIELDS(ControllerDescription, kControllerFields)

std::span<const Kind> region_kinds() { return kRegionKinds; }

}  // namespace sim
