// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/run_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "grade/figures.h"

namespace playpen::grade {
namespace {

using nlohmann::json;

/// A run with a value for every member but `asked`; all its numbers differ, and none is short in
/// decimals.
GradedRun full_run() {
  GradedRun run;
  run.world = "ro\"om\n\xc3\xa9";
  run.seed = std::numeric_limits<std::uint64_t>::max();
  run.folder = "room_seed1";
  run.robot = "r1";
  run.goal = Goal{{1.0 / 3.0, -2.0 / 3.0}, 0.1 + 0.2, 0.7 / 9.0, 1.1 / 7.0};
  run.ending = Ending::kBadStatus;
  run.status = 3;
  run.signal = 11;
  double number = 1.0 / 7.0;
  const auto next = [&number] { return number *= 1.1; };
  Measures& m = run.measures;
  m.reached = false;
  m.collisions = 7;
  for (const Figure& figure : kFigures) {
    if (const auto* member = std::get_if<std::optional<double> Measures::*>(&figure.member)) {
      m.*(*member) = next();
    }
  }
  m.score = -0.0;
  m.path_ratio = std::numeric_limits<double>::denorm_min();
  m.distance_m = std::numeric_limits<double>::max();
  m.first_collision = Contact{next(), "border", {next(), -next()}};
  m.first_collision->sight =
      Sight{Sight::State::kTooHigh, "eyes", next(), next(), next(), -next(), next()};
  m.verdict = false;
  m.verdict_reason = "caught";
  m.commanded = {"r1", "r2"};
  m.refused = {{next(), "the map of the world"}, {next(), "poses"}};
  run.faults = {"3 collisions, at most 0 allowed", ""};
  run.wall_time_s = next();
  return run;
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

std::optional<std::uint64_t> bits(const std::optional<double>& value) {
  return value ? std::optional(bits(*value)) : std::nullopt;
}

void expect_equal_figures(const Measures& a, const Measures& b) {
  for (const Figure& figure : kFigures) {
    SCOPED_TRACE(std::string(figure.name));
    if (const auto* number = std::get_if<std::optional<double> Measures::*>(&figure.member)) {
      EXPECT_EQ(bits(a.*(*number)), bits(b.*(*number)));
    } else if (const auto* count = std::get_if<std::optional<int> Measures::*>(&figure.member)) {
      EXPECT_EQ(a.*(*count), b.*(*count));
    } else {
      const auto member = std::get<std::optional<bool> Measures::*>(figure.member);
      EXPECT_EQ(a.*member, b.*member);
    }
  }
}

void expect_equal_goals(const std::optional<Goal>& a, const std::optional<Goal>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(bits(a->position.x()), bits(b->position.x()));
  EXPECT_EQ(bits(a->position.y()), bits(b->position.y()));
  EXPECT_EQ(bits(a->yaw_rad), bits(b->yaw_rad));
  EXPECT_EQ(bits(a->tolerance_m), bits(b->tolerance_m));
  EXPECT_EQ(bits(a->yaw_tolerance_rad), bits(b->yaw_tolerance_rad));
}

void expect_equal_collisions(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(bits(a->time_s), bits(b->time_s));
  EXPECT_EQ(a->partner, b->partner);
  EXPECT_EQ(bits(a->place.x()), bits(b->place.x()));
  EXPECT_EQ(bits(a->place.y()), bits(b->place.y()));
  ASSERT_EQ(a->sight.has_value(), b->sight.has_value());
  if (!a->sight) return;
  EXPECT_EQ(a->sight->state, b->sight->state);
  EXPECT_EQ(a->sight->sensor, b->sight->sensor);
  EXPECT_EQ(bits(a->sight->shown_for_s), bits(b->sight->shown_for_s));
  EXPECT_EQ(bits(a->sight->last_shown_s), bits(b->sight->last_shown_s));
  EXPECT_EQ(bits(a->sight->distance_m), bits(b->sight->distance_m));
  EXPECT_EQ(bits(a->sight->bearing_rad), bits(b->sight->bearing_rad));
  EXPECT_EQ(bits(a->sight->field_of_view_rad), bits(b->sight->field_of_view_rad));
}

/// All members but `asked` are equal, numbers to the bit.
void expect_equal(const GradedRun& a, const GradedRun& b) {
  EXPECT_EQ(a.world, b.world);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.folder, b.folder);
  EXPECT_EQ(a.robot, b.robot);
  EXPECT_EQ(a.ending, b.ending);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.signal, b.signal);
  EXPECT_EQ(a.faults, b.faults);
  EXPECT_EQ(bits(a.wall_time_s), bits(b.wall_time_s));
  expect_equal_goals(a.goal, b.goal);
  expect_equal_figures(a.measures, b.measures);
  expect_equal_collisions(a.measures.first_collision, b.measures.first_collision);
  EXPECT_EQ(a.measures.verdict, b.measures.verdict);
  EXPECT_EQ(a.measures.verdict_reason, b.measures.verdict_reason);
  EXPECT_EQ(a.measures.commanded, b.measures.commanded);
  ASSERT_EQ(a.measures.refused.size(), b.measures.refused.size());
  for (std::size_t i = 0; i < a.measures.refused.size(); ++i) {
    EXPECT_EQ(bits(a.measures.refused[i].time_s), bits(b.measures.refused[i].time_s));
    EXPECT_EQ(a.measures.refused[i].what, b.measures.refused[i].what);
  }
}

TEST(RunRecord, FullRun_ReadBackToTheBit) {
  const GradedRun run = full_run();
  const std::string text = run_text(run);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const std::optional<GradedRun> again = read_run(text);
  ASSERT_TRUE(again);
  expect_equal(*again, run);
  EXPECT_EQ(run_text(*again), text);
}

TEST(RunRecord, EmptyRun_ReadBack) {
  const std::optional<GradedRun> again = read_run(run_text({}));
  ASSERT_TRUE(again);
  expect_equal(*again, {});
}

TEST(RunRecord, EveryEnding_ReadBack) {
  for (const Ending ending : kEndings) {
    GradedRun run;
    run.ending = ending;
    const std::optional<GradedRun> again = read_run(run_text(run));
    ASSERT_TRUE(again) << name_of(ending);
    EXPECT_EQ(again->ending, ending);
  }
}

TEST(RunRecord, PassedVerdict_ReadBack) {
  GradedRun run;
  run.measures.verdict = true;
  run.goal = Goal{};
  const std::optional<GradedRun> again = read_run(run_text(run));
  ASSERT_TRUE(again);
  expect_equal(*again, run);
}

TEST(RunRecord, InvalidUtf8_Replaced) {
  GradedRun run;
  run.faults = {"\xff"};
  const std::optional<GradedRun> again = read_run(run_text(run));
  ASSERT_TRUE(again);
  EXPECT_THAT(again->faults, testing::ElementsAre("\xef\xbf\xbd"));
}

TEST(RunRecord, TextCutShort_Refused) {
  const std::string text = run_text(full_run());
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_FALSE(read_run(std::string_view(text).substr(0, size))) << size;
  }
  EXPECT_FALSE(read_run(text + text));
}

/// The text of the full run with another value at a JSON pointer.
std::string changed(const char* pointer, const json& value) {
  json record = json::parse(run_text(full_run()));
  record[json::json_pointer(pointer)] = value;
  return record.dump();
}

TEST(RunRecord, BadMembers_Refused) {
  ASSERT_TRUE(read_run(changed("/status", nullptr)) == std::nullopt);  // not a member
  struct Case {
    const char* pointer;
    json value;
  };
  const Case cases[] = {
      {"/passed", true},  // there are faults
      {"/passed", "no"},
      {"/world", 1},
      {"/world", nullptr},
      {"/seed", -1},
      {"/seed", 1.5},
      {"/seed", 1e30},
      {"/end", "bad-status"},
      {"/end/kind", "gone"},
      {"/end/kind", "by-itself"},  // has no status
      {"/end/status", 3'000'000'000},
      {"/end/status", 1.5},
      {"/end/signal", "11"},
      {"/goal", 7},
      {"/goal/x", nullptr},
      {"/goal/yaw", "north"},
      {"/reached", 1},
      {"/collisions", 1.5},
      {"/collisions", 1e300},
      {"/coverage", "all"},
      {"/coverage", true},
      {"/first_collision", json::object()},
      {"/verdict", "perhaps"},
      {"/verdict", nullptr},  // has no reason
      {"/commanded", "r1"},
      {"/commanded/0", 1},
      {"/refused/0", "map"},
      {"/faults", json::array()},  // then it has passed
      {"/wall_time", nullptr},
      {"/another", 1},
      {"/goal/another", 1},
  };
  for (const Case& bad : cases) {
    EXPECT_FALSE(read_run(changed(bad.pointer, bad.value)))
        << bad.pointer << ' ' << bad.value.dump();
  }
  EXPECT_TRUE(read_run(changed("/seed", 4)));
}

TEST(RunRecord, EveryMember_Required) {
  const json whole = json::parse(run_text(full_run()));
  for (const auto& [key, value] : whole.items()) {
    json less = whole;
    less.erase(key);
    EXPECT_FALSE(read_run(less.dump())) << key;
  }
}

TEST(RunRecord, OtherJson_Refused) {
  for (const char* text : {"", "{}", "[]", "null", "7", "\"text\"", "[{}]", "{\"world\": \"a\"}"}) {
    EXPECT_FALSE(read_run(text)) << text;
  }
}

}  // namespace
}  // namespace playpen::grade
