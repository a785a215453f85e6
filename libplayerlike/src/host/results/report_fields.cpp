// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The tables of the report. Keys are written in the order of the tables.
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "playerlike/host/report.h"
#include "protocol/field_codec.h"
#include "protocol/message_table.h"

namespace sim {
namespace {

namespace protocol = playerlike::protocol;

constexpr MessageForm kIntegers = {
    [](const void* value, protocol::Encoding) -> nlohmann::json {
      return *static_cast<const std::vector<int>*>(value);
    },
    [](const nlohmann::json& object, const char* key, protocol::Encoding, void* value) {
      const auto& list = protocol::require_list(protocol::require(object, key), key);
      for (const nlohmann::json& number : list) {
        static_cast<std::vector<int>*>(value)->push_back(static_cast<int>(
            protocol::require_integer({{key, number}}, key, std::numeric_limits<int>::min(),
                                      std::numeric_limits<int>::max())));
      }
    }};

constexpr const char* kEnds[] = {"duration", "verdict", "program",   "request",
                                 "window",   "signal",  "real robot"};

}  // namespace

MESSAGE(playerlike::RunEnd, field<&T::by>("by", "", "see below").one_of(kEnds),
        field<&T::status>("status", "", "exit status of the program, if that ended the run"),
        field<&T::signal>("signal", "",
                          "name of the signal that asked for the end or killed the program"))
MESSAGE(playerlike::SeriesReport, field<&T::mean>("mean"), field<&T::max>("max"))
MESSAGE(playerlike::MirrorReport::Loss,
        field<&T::time_s>("time", "s", "when it was lost last; `lost` is `null` if it was not"),
        field<&T::reason>("reason", "", "why it was lost"))
MESSAGE(playerlike::MirrorReport::ScanDifference,
        field<&T::range_m>("range", "m", "`mean` and `max` of the column `scan_difference`"),
        field<&T::share>("share", "", "`mean` and `max` of the column `scan_difference_share`"))
MESSAGE(playerlike::MirrorReport::GhostDifference,
        field<&T::distance_m>("distance", "m",
                              "`mean` and `max` of the distance between robot and ghost"),
        field<&T::final_distance_m>("final_distance", "m", "the last distance"),
        field<&T::heading_rad>("heading", "rad",
                               "`mean` and `max` of the difference of their headings"))
MESSAGE(playerlike::MirrorReport, field<&T::robot>("robot", "", "name of the robot in the world"),
        field<&T::server>("server", "", "as in the world"),
        field<&T::drive>("drive", "", "as in the world"),
        field<&T::connected>("connected", "",
                             "whether there was a connection at the end of the run"),
        field<&T::lost>("lost").nullable(),
        field<&T::reconnections>("reconnections", "", "how often it was made again"),
        field<&T::readings>("readings", "", "number of readings that arrived"),
        field<&T::poses>("poses", "", "number of used poses"),
        field<&T::scans>("scans", "", "number of compared scans"),
        field<&T::latency_s>("latency", "s",
                             "`mean` and `max` of the wall-clock time from the arrival of a "
                             "reading until the program can read it")
            .nullable(),
        field<&T::screen_latency_s>("screen_latency", "s",
                                    "`mean` and `max` of the wall-clock time from the arrival of a "
                                    "scan until the live window shows it; `null` without a window")
            .nullable(),
        field<&T::scan_difference>("scan_difference").nullable(),
        field<&T::ghost>("ghost").nullable().or_default())
MESSAGE(
    playerlike::Report::Run, field<&T::world>("world", "", "the world's name").or_default(),
    field<&T::seed>("seed", "", "of all random numbers").or_default(),
    field<&T::realism>("realism", "", "[level of realism](realism.md)").or_default(),
    field<&T::steps>("steps", "", "simulated steps").or_default(),
    field<&T::sim_time_s>("sim_time", "s", "simulated time"),
    field<&T::wall_time_s>("wall_time", "s", "wall-clock time from the first step to the last")
        .or_default(),
    field<&T::real_time_factor>("real_time_factor", "", "`sim_time` divided by `wall_time`")
        .or_default(),
    field<&T::state_hash>("state_hash", "",
                          "hash of the final state; equal runs have equal hashes; `null` while "
                          "the run goes on, and if the program died")
        .nullable()
        .or_default(),
    field<&T::world_file>(
        "world_file", "",
        "the world's file, if the world has one; [`playpen plot`](command.md#plot) reads it"),
    field<&T::repeatable>(
        "repeatable", "",
        "whether another run gives the same result; `false` if a wall-clock rule affected the "
        "run, see [virtual time](virtual_time.md#when-a-run-is-not-repeatable)")
        .or_default(),
    field<&T::repeatable_why>("repeatable_why", "",
                              "the reasons why the run is not repeatable, a list of sentences"),
    field<&T::repeatable_on>(
        "repeatable_on", "",
        "machines on which another run gives the same bits: `any machine`, `any x86-64 machine` "
        "or `any aarch64 machine`; see "
        "[trust](trust.md#the-same-result-on-every-machine)"),
    field<&T::box2d_from_s>("box2d_from", "s",
                            "when a robot first touched something or might have, so that Box2D "
                            "computed part of the result; missing: never"))
MESSAGE(playerlike::Report::Seen, field<&T::area_m2>("area").or_default(),
        field<&T::cell_size_m>("cell_size"), field<&T::origin>(""), field<&T::width>("width"),
        field<&T::height>("height"), field<&T::cells>("cells"))
MESSAGE(playerlike::Report::Commanded, field<&T::first_s>("first", "s", "time of the first one"),
        field<&T::commands>("commands", "", "their number").or_default(),
        field<&T::ports>("ports", kIntegers)
            .with<&Field::meaning>("ports of the clients that sent them")
            .or_default())
MESSAGE(playerlike::Report::Robot, field<&T::name>("name", "", "the robot's name"),
        field<&T::path_length_m>("path_length", "m", "length of the path of the robot's centre"),
        field<&T::collisions>("collisions", "",
                              "number of contacts with obstacles, borders or robots; a contact "
                              "counts once, when it starts"),
        field<&T::least_clearance_m>("least_clearance", "m",
                                     "least distance of the robot's body to anything solid; 0 "
                                     "after a collision; `null`: there is nothing solid")
            .nullable(),
        field<&T::stalled_time_s>("stalled_time", "s",
                                  "time during which the robot could not move as commanded"),
        field<&T::final_pose>("final_pose", "m, rad", "true `x`, `y`, `yaw`").or_default(),
        field<&T::driven_time_s>(
            "driven_time", "s",
            "time during which the motors were commanded to move the robot; a robot that stalled "
            "for more than half of it [may be in the wrong world](which_world.md)"),
        field<&T::distance_m>("distance", "m",
                              "distance driven between places: the sum of straight moves of at "
                              "least 0.25 m. Movements on the spot and jumps do not count"),
        field<&T::visited_area_m2>(
            "visited_area", "m²",
            "area of the squares of 0.25 m in which the robot's centre has been"),
        field<&T::seen>("seen", "",
                        "the floor that the robot's range sensors have seen; only in [graded "
                        "runs](grading.md#how-things-are-measured) with a map"),
        field<&T::commanded>("commanded", "",
                             "commands of programs that move the robot; `null`: there was none")
            .nullable()
            .or_default())
MESSAGE(playerlike::Report::Said, field<&T::time_s>("time", "s", "when it began"),
        field<&T::robot>("robot", "", "name of the robot"),
        field<&T::text>("text", "", "what it said"))
MESSAGE(playerlike::Report::Collision, field<&T::time_s>("time", "s", "when the contact started"),
        field<&T::robot>("robot", "", "name of the robot"),
        field<&T::with>("with", "", "name of the obstacle or robot, `border` or `wall`"),
        field<&T::place>("", "m", "the place"))
MESSAGE(playerlike::Report::Goal, field<&T::time_s>("time", "s", "when the goal was set"),
        field<&T::robot>("robot", "", "name of the robot"), field<&T::place>("", "m", "the place"),
        field<&T::reached_s>(
            "reached", "s",
            "the first time when the robot was within the tolerance of the goal, or `null`")
            .nullable())
MESSAGE(playerlike::Report::Event, field<&T::number>("number").or_default(),
        field<&T::time_s>("time", "s").or_default(), field<&T::kind>("kind"),
        field<&T::what>("what"), field<&T::who>("who"), field<&T::text>("text"),
        field<&T::value>("value"))
MESSAGE(playerlike::Report::Block, field<&T::name>("name"), field<&T::state>(""))
MESSAGE(playerlike::Report::Score, field<&T::robot>("robot"), field<&T::points>(""))
MESSAGE(playerlike::Report::Verdict, field<&T::passed>("passed", "", "whether the run has passed"),
        field<&T::reason>("reason", "", "as the action says"),
        field<&T::time_s>("time", "s", "when the action ended the run"))
MESSAGE(playerlike::Report::Refusal, field<&T::time_s>("time", "s", "of the first time"),
        field<&T::what>("what", "", "what it was"))
MESSAGE(playerlike::Report::Graded, field<&T::nonce>("nonce"), field<&T::world_name>("world_name"),
        field<&T::world>("world"), field<&T::seed>("seed"),
        field<&T::duration_s>("duration").nullable(), field<&T::time>("time"),
        field<&T::realism>("realism"), field<&T::rules>("rules"), field<&T::signature>("signature"))
MESSAGE(
    playerlike::Report, field<&T::run>("run"), field<&T::robots>("robots"),
    field<&T::said>("said", "",
                    "texts that robots said ([speech](devices/speech.md)); the last 1024")
        .or_default(),
    field<&T::collisions>("collisions", "", "starts of contacts; the last 1024").or_default(),
    field<&T::goals>(
        "goals", "",
        "goals of robots: those of waypoint devices, of `GoTo()` and of SND; the last 1024")
        .or_default(),
    field<&T::events>("events", "",
                      "[events](arena_controller.md#events) of the arena, if it can change"),
    field<&T::blocks>("blocks", "",
                      "[states](arena_controller.md#events) of dynamic blocks by their names, if "
                      "the arena can change")
        .keyed(),
    field<&T::scores>(
        "scores", "",
        "points by the names of the robots; only with an [arena controller](arena_controller.md)")
        .keyed(),
    field<&T::verdict>("verdict", "",
                       "the verdict of the [arena controller](arena_controller.md#actions), if "
                       "there is one; `null`: there was no verdict")
        .nullable()
        .or_default(),
    field<&T::refused>("refused", "",
                       "what a [task](grading.md#what-a-program-may-use) has refused to the "
                       "program; only if there is something"),
    field<&T::mirror>("mirror", "", "robots that [mirror real ones](mirror.md#results)"),
    field<&T::ended>("ended", "",
                     "how the run ended; `null`: the run had not ended when the file was written")
        .nullable()
        .or_default(),
    field<&T::graded>("graded", "", "settings and signature of a [graded run](grading.md)"))

#undef MESSAGE
#undef MESSAGE_CHECKED

}  // namespace sim

namespace playerlike {

std::string signal_name(int number) {
  const char* const name = sigabbrev_np(number);
  return name != nullptr ? std::string("SIG") + name : std::to_string(number);
}

std::string text_of_report(const Report& report) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  protocol::write_fields(sim::fields_of<Report>(), &report, out, protocol::Encoding::kJson);
  // Where there can be none, they are missing instead of null.
  if (!report.scores) out.erase("verdict");
  if (report.mirror) {
    for (nlohmann::ordered_json& robot : out["mirror"]) {
      if (robot["drive"] != "both") robot.erase("ghost");
    }
  }
  return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

Report report_from(const std::string& text) {
  Report report;
  protocol::read_fields(sim::fields_of<Report>(), nlohmann::ordered_json::parse(text),
                        protocol::Encoding::kJson, &report);
  return report;
}

}  // namespace playerlike
