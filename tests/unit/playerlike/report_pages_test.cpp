// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The pages list the keys of report.json as the tables of fields do. PLAYPEN_WRITE_PAGES=1 writes
// them anew. Reports are read as they were written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "field_pages.h"
#include "playerlike/host/report.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

const std::string kDocs = PLAYPEN_SOURCE_DIR "/docs/";

std::string row(const std::string& key, const sim::Field& field) {
  const std::string unit = field.range.unit;
  return "| `" + key + "` | " + (unit.empty() ? "–" : unit) + " | " + field.meaning + " |\n";
}

// Rows of the fields that have a meaning, and of the fields within lists and structs.
std::string rows(const sim::FieldTable& table, const std::string& prefix) {
  std::string all;
  for (const sim::Field& field : table.fields) {
    const bool is_list = field.type == sim::FieldType::kList;
    const std::string key = prefix + field.name + (is_list && !field.is_keyed ? "[]" : "");
    if (*field.name == '\0') {
      all += *field.meaning == '\0' ? "" : row(prefix + "x`, `" + prefix + "y", field);
      continue;
    }
    if (*field.meaning != '\0') all += row(key, field);
    const bool has_fields = field.table != nullptr && !field.is_keyed;
    const bool has_page = field.table == &sim::fields_of<MirrorReport>;
    if (has_fields && !has_page) all += rows(field.table(), key + ".");
  }
  return all;
}

// Compares the first table of a page after a text with that of a struct.
void expect_table(const std::string& name, const std::string& after, const sim::FieldTable& table) {
  const std::string page = test_support::read_bytes(kDocs + name);
  const std::size_t text = page.find(after);
  ASSERT_NE(text, std::string::npos) << name << ": " << after;
  const std::size_t first = page.find("\n| key |", text) + 1;
  const std::size_t last = std::min(page.find("\n\n", first) + 1, page.size());
  const std::string made = "| key | unit | meaning |\n|---|---|---|\n" + rows(table, "");
  if (sim::test::writes_pages()) {
    sim::test::write_page(kDocs + name, page.substr(0, first) + made + page.substr(last));
  } else {
    EXPECT_EQ(page.substr(first, last - first), made) << "PLAYPEN_WRITE_PAGES=1 writes it anew";
  }
}

TEST(ReportPages, Tables_MatchFields) {
  expect_table("start_here.md", "\n`report.json`:\n", sim::fields_of<Report>());
  expect_table("mirror.md", "\n`mirror` in `report.json` ", sim::fields_of<MirrorReport>());
}

// A report with each member.
Report whole_report() {
  Report report;
  report.run = {"w",    7,         "real", 3,         0.03,          1.5, 0.02,
                "00ff", "/w.json", false,  {{"why"}}, "any machine", 1.5};
  Report::Robot robot;
  robot.name = "r10";
  robot.path_length_m = 0.1;
  robot.collisions = 2;
  robot.least_clearance_m = 0.25;
  robot.stalled_time_s = 0.5;
  robot.final_pose = {1.0, 2.0, 3.0};
  robot.driven_time_s = 1.0 / 3.0;
  robot.distance_m = 2.0;
  robot.visited_area_m2 = 0.0625;
  robot.seen = Report::Seen{0.5, 0.02, {1.0, 2.0}, 4, 2, {0xa5}};
  robot.commanded = Report::Commanded{0.1, 2, {6665, 6666}};
  report.robots = {robot, Report::Robot{}};
  report.said = {{0.1, "r10", "hello"}};
  report.collisions = {{0.2, "r10", "wall", {1.0, 2.0}}};
  report.goals = {{0.1, "r10", {1.0, 2.0}, 0.3}, {0.1, "r2", {1.0, 2.0}, std::nullopt}};
  report.events = {{1, 0.1, "trap", "p", "r10", "enter", 2.0},
                   {2, 0.2, "reset", "world", {}, {}, {}}};
  report.blocks = {{"gate", "extended"}, {"door", "waiting"}};
  report.scores = {{"r10", 2.0}, {"r2", -0.5}};
  report.verdict = Report::Verdict{true, "at the goal", 0.3};
  report.refused = {{0.1, "the map"}};
  MirrorReport mirror;
  mirror.robot = "r10";
  mirror.lost = {0.2, "cut"};
  mirror.latency_s = {0.1, 0.2};
  mirror.scan_difference = {{0.1, 0.2}, {0.3, 0.4}};
  mirror.ghost = MirrorReport::GhostDifference{{0.1, 0.2}, 0.15, {0.3, 0.4}};
  report.mirror = {mirror, MirrorReport{}};
  report.mirror->at(0).drive = "both";
  report.ended = RunEnd{RunEnd::By::kRealRobot, 3, "SIGINT"};
  report.graded = Report::Graded{"n", "w", "ff", 7, std::nullopt, "lockstep", "real", "all", "s"};
  return report;
}

TEST(Report, TextRead_WritesSameText) {
  const Report whole = whole_report();
  const std::string text = text_of_report(whole);
  EXPECT_EQ(text_of_report(report_from(text)), text);
  const Report least;
  const std::string short_text = text_of_report(least);
  EXPECT_EQ(text_of_report(report_from(short_text)), short_text);
  // Elements and keys keep their order, which is not that of the alphabet.
  EXPECT_LT(text.find("\"gate\""), text.find("\"door\""));
  EXPECT_LT(text.find("\"robots\""), text.find("\"collisions\": ["));
  EXPECT_EQ(report_from(text).blocks->at(0).name, "gate");
  for (const char* key : {"verdict", "scores", "ghost", "refused", "mirror", "graded"}) {
    EXPECT_EQ(short_text.find(key), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace playerlike
