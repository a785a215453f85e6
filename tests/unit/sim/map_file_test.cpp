// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

#include "sim/core/error.h"
#include "sim/render/render.h"
#include "temporary_folder.h"

namespace sim::io {
namespace {

using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

OccupancyMap map_of(int width, int height, std::vector<float> cells) {
  return {width, height, 0.05, {-1.5, 2.25}, std::move(cells)};
}

/// A description with one line replaced; `line` begins with the key of the replaced line.
std::string description_with(const std::string& line = "") {
  const std::string key = line.substr(0, line.find(':'));
  std::string text;
  for (const char* usual : {"image: map.pgm", "resolution: 0.1", "origin: [1, 2, 0]", "negate: 0",
                            "occupied_thresh: 0.65", "free_thresh: 0.196"}) {
    const bool replaced = !key.empty() && std::string(usual).starts_with(key + ":");
    text += (replaced ? line : usual) + std::string("\n");
  }
  const bool new_key = !key.empty() && text.find(line) == std::string::npos;
  return new_key ? text + line + '\n' : text;
}

std::vector<ConfigIssue> issues_of(const std::string& file) {
  try {
    static_cast<void>(read_map(file));
  } catch (const ConfigError& error) {
    return error.issues();
  }
  return {};
}

TEST(MapFile, Trinary_RoundTrips) {
  const TemporaryFolder folder;
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    std::uniform_int_distribution<int> side(1, 40);
    std::uniform_real_distribution<double> number(-100.0, 100.0);
    OccupancyMap map{side(random),
                     side(random),
                     std::abs(number(random)) + 1e-4,
                     {number(random), number(random)},
                     {}};
    for (int i = map.width * map.height; i > 0; --i) {
      map.cells.push_back(0.5F * static_cast<float>(random() % 3));
    }
    write_map(map, folder / "map.v2");
    const OccupancyMap back = read_map(folder / "map.v2.yaml");
    EXPECT_EQ(back.width, map.width);
    EXPECT_EQ(back.height, map.height);
    EXPECT_EQ(back.cell_size_m, map.cell_size_m);  // written with all digits
    EXPECT_EQ(back.origin, map.origin);
    EXPECT_EQ(back.cells, map.cells);
  }
}

TEST(MapFile, Trinary_FreeOccupiedAndUnknown) {
  const TemporaryFolder folder;
  write_map(map_of(4, 2, {0.1F, 0.19F, 0.2F, 0.6F, 0.66F, -3.0F, 9.0F, kNaN}), folder / "m");
  EXPECT_EQ(read_bytes(folder / "m.pgm"),
            std::string("P5\n4 2\n255\n\xfe\xfe\xcd\xcd\0\xfe\0\xcd", 19));
  EXPECT_EQ(read_bytes(folder / "m.yaml"),
            "image: m.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.5, 2.25, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  EXPECT_THAT(read_map(folder / "m.yaml").cells,
              ElementsAre(0.0F, 0.0F, 0.5F, 0.5F, 1.0F, 0.0F, 1.0F, 0.5F));
}

TEST(MapFile, Scale_KeepsShades) {
  const TemporaryFolder folder;
  OccupancyMap map = map_of(1001, 1, {});
  for (int i = 0; i <= 1000; ++i) map.cells.push_back(static_cast<float>(i) / 1000.0F);
  write_map(map, folder / "shades", MapMode::kScale);
  const OccupancyMap back = read_map(folder / "shades.yaml");
  ASSERT_EQ(back.cells.size(), map.cells.size());
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    // Half a grey level of 255 is 1/510; the thresholds stretch it by 1/0.996.
    ASSERT_NEAR(back.cells[i], map.cells[i], 1.0 / 500) << i;
  }
  EXPECT_EQ(back.cells.front(), 0.0F);
  EXPECT_EQ(back.cells.back(), 1.0F);
  write_map(map_of(3, 1, {-1.0F, 2.0F, kNaN}), folder / "odd", MapMode::kScale);
  const std::vector<float> odd = read_map(folder / "odd.yaml").cells;
  EXPECT_EQ(odd[0], 0.0F);
  EXPECT_EQ(odd[1], 1.0F);
  EXPECT_NEAR(odd[2], 0.5, 1.0 / 500);
}

TEST(MapFile, AmbiguousYamlNames_RoundTrip) {
  const TemporaryFolder folder;
  for (const char* stem : {"# my: map", "null", "a 'b' \"c\"", "- x"}) {
    write_map(map_of(1, 1, {1.0F}), folder / stem);
    EXPECT_THAT(read_map(folder / (std::string(stem) + ".yaml")).cells, ElementsAre(1.0F)) << stem;
  }
}

TEST(MapFile, UnwritableFile_ErrorNamesIt) {
  const TemporaryFolder folder;
  try {
    write_map(map_of(1, 1, {0.0F}), folder / "no/folder/map");
    FAIL() << "wrote into a folder that is not there";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(folder / "no/folder/map.pgm"),
                                    HasSubstr("No such file or directory")));
  }
}

TEST(MapFile, MapSaverFile_Read) {
  const TemporaryFolder folder;
  folder.write("map.pgm", "P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n3 1\n255\n" +
                              std::string("\xfe\xcd\0", 3));
  const std::string yaml = folder.write(
      "map.yaml",
      "image: map.pgm\nresolution: 0.050000\norigin: [-10.000000, -12.500000, 0.000000]\n"
      "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n");
  const OccupancyMap map = read_map(yaml);
  EXPECT_EQ(map.width, 3);
  EXPECT_EQ(map.height, 1);
  EXPECT_EQ(map.cell_size_m, 0.05);
  EXPECT_EQ(map.origin, Vec2(-10.0, -12.5));
  EXPECT_THAT(map.cells, ElementsAre(0.0F, 0.5F, 1.0F));
}

TEST(MapFile, ForeignYaml_ReadWithoutItsOtherKeys) {
  const TemporaryFolder folder;
  folder.write("pictures/map.pgm", "P2\n2 1\n255\n255 0\n");
  const std::string yaml =
      folder.write("map.yaml",
                   "# a map\n---\nfree_thresh: 0.25\nimage: \"pictures/map.pgm\"\n"
                   "mode: trinary\nnegate: false  # as usual\n"
                   "occupied_thresh: 0.65\norigin:\n- -1.0\n- 2\n- 0.0\n"
                   "resolution: 5e-2\nextra: {a: [1, 2]}\n");
  const OccupancyMap map = read_map(yaml);
  EXPECT_EQ(map.cell_size_m, 0.05);
  EXPECT_EQ(map.origin, Vec2(-1.0, 2.0));
  EXPECT_THAT(map.cells, ElementsAre(0.0F, 1.0F));
}

TEST(MapFile, ModeAndNegate_ConvertShades) {
  const TemporaryFolder folder;
  folder.write("map.pgm", "P2\n5 1\n255\n0 51 100 204 255\n");
  const auto cells = [&](const std::string& lines) {
    return read_map(folder.write("map.yaml", description_with() + lines)).cells;
  };
  // p = 1, 0.8, 0.61, 0.2, 0
  EXPECT_THAT(cells(""), ElementsAre(1.0F, 1.0F, 0.5F, 0.5F, 0.0F));
  const std::vector<float> scale = cells("mode: scale\n");
  EXPECT_THAT((std::vector<float>{scale[0], scale[1], scale[4]}), ElementsAre(1.0F, 1.0F, 0.0F));
  EXPECT_NEAR(scale[2], (155.0 / 255.0 - 0.196) / (0.65 - 0.196), 1e-6);
  EXPECT_NEAR(scale[3], (51.0 / 255.0 - 0.196) / (0.65 - 0.196), 1e-6);
  EXPECT_THAT(cells("mode: raw\n"), ElementsAre(0.0F, 0.51F, 1.0F, 0.5F, 0.5F));

  const auto negated = [&](const std::string& lines) {
    return read_map(folder.write("map.yaml", description_with("negate: 1") + lines)).cells;
  };
  // p = 0, 0.2, 0.39, 0.8, 1
  EXPECT_THAT(negated(""), ElementsAre(0.0F, 0.5F, 0.5F, 1.0F, 1.0F));
  EXPECT_THAT(negated("mode: raw\n"), ElementsAre(0.5F, 0.5F, 0.5F, 0.51F, 0.0F));
}

TEST(MapFile, Png_Read) {
  const TemporaryFolder folder;
  render::write_png({3, 1, {255, 255, 255, 0, 0, 0, 128, 128, 128}}, folder / "map.png");
  const std::string yaml = folder.write("map.yaml", description_with("image: map.png"));
  EXPECT_THAT(read_map(yaml).cells, ElementsAre(0.0F, 1.0F, 0.5F));
}

struct BadMap {
  const char* line;  ///< of the description
  const char* id;
  const char* pointer;
  int line_number;  ///< 0: of the whole file
  const char* expected;
  const char* found;
};

TEST(MapFile, InvalidDescription_Explained) {
  const BadMap kBad[] = {
      {"resolution: x", "map/wrong-type", "/resolution", 2, "over 0", "\"x\""},
      {"resolution: 0", "map/out-of-range", "/resolution", 2, "over 0", "0"},
      {"resolution: -0.1", "map/out-of-range", "/resolution", 2, "over 0", "-0.1"},
      {"resolution: .nan", "map/out-of-range", "/resolution", 2, "over 0", ".nan"},
      {"resolution: .inf", "map/out-of-range", "/resolution", 2, "1000 m", ".inf"},
      {"resolution: 1e999", "map/wrong-type", "/resolution", 2, "1000 m", "1e999"},
      {"resolution: [1]", "map/wrong-type", "/resolution", 2, "over 0", "a list of 1"},
      {"resolution: ~", "map/wrong-type", "/resolution", 2, "over 0", "nothing"},
      {"origin: 3", "map/wrong-type", "/origin", 3, "[x, y, yaw]", "\"3\""},
      {"origin: [1, 2]", "map/wrong-type", "/origin", 3, "[x, y, yaw]", "a list of 2"},
      {"origin: [1, .nan, 0]", "map/out-of-range", "/origin/1", 3, "1e6 m", ".nan"},
      {"origin: [x, 2, 0]", "map/wrong-type", "/origin/0", 3, "a number", "\"x\""},
      {"origin: [1, 2, 1.57]", "map/turned", "/origin/2", 3, "a yaw of 0", "1.57"},
      {"origin: [1, 2, .nan]", "map/out-of-range", "/origin/2", 3, "rad", ".nan"},
      {"negate: 2", "map/wrong-type", "/negate", 4, "0 or 1", "\"2\""},
      {"occupied_thresh: 1.5", "map/out-of-range", "/occupied_thresh", 5, "from 0 to 1", "1.5"},
      {"free_thresh: -0.1", "map/out-of-range", "/free_thresh", 6, "from 0 to 1", "-0.1"},
      {"free_thresh: 0.65", "map/thresholds", "/free_thresh", 6, "less than occupied_thresh",
       "0.65"},
      {"mode: scala", "map/mode", "/mode", 7, "\"raw\"", "\"scala\" (did you mean \"scale\"?)"},
      {"image: [a]", "map/wrong-type", "/image", 1, "name of a picture", "a list of 1"},
      {"image: nowhere.pgm", "map/image", "/image", 1, "PNG or PGM", "nowhere.pgm"},
      {"image: map.yaml", "map/image", "/image", 1, "PNG or PGM", "not a PNG or PGM picture"},
      {"origin: [1, 2", "map/syntax", "", 4, "YAML", "end of sequence"},
      {"mode: [", "map/syntax", "", 8, "YAML", "end of sequence"},
      {"mode: a: b", "map/syntax", "", 7, "YAML", "illegal map value"},
  };
  const TemporaryFolder folder;
  folder.write("map.pgm", "P2\n1 1\n255\n0\n");
  for (const BadMap& bad : kBad) {
    const std::string file = folder.write("map.yaml", description_with(bad.line));
    const std::vector<ConfigIssue> issues = issues_of(file);
    ASSERT_EQ(issues.size(), 1U) << bad.line;
    EXPECT_EQ(issues[0].id, bad.id) << bad.line;
    EXPECT_EQ(issues[0].file, file);
    EXPECT_EQ(issues[0].pointer, bad.pointer) << bad.line;
    EXPECT_EQ(issues[0].line, bad.line_number) << bad.line;
    EXPECT_THAT(issues[0].expected, HasSubstr(bad.expected));
    EXPECT_THAT(issues[0].found + (issues[0].hint.empty() ? "" : " (" + issues[0].hint + ")"),
                HasSubstr(bad.found));
  }
}

TEST(MapFile, MissingKeys_AllNamed) {
  const TemporaryFolder folder;
  const std::vector<ConfigIssue> issues = issues_of(folder.write("m.yaml", "mode: trinary\n"));
  std::string found;
  for (const ConfigIssue& issue : issues) {
    EXPECT_EQ(issue.id, "map/missing-key");
    EXPECT_EQ(issue.line, 0);
    found += issue.found + ' ';
  }
  EXPECT_EQ(found,
            "no key \"image\" no key \"resolution\" no key \"origin\" no key \"negate\" "
            "no key \"occupied_thresh\" no key \"free_thresh\" ");
}

TEST(MapFile, OtherFile_NoDescription) {
  const TemporaryFolder folder;
  const auto id_of = [](const std::string& file) {
    const std::vector<ConfigIssue> issues = issues_of(file);
    return issues.size() == 1 ? issues[0].id : std::to_string(issues.size()) + " issues";
  };
  EXPECT_EQ(id_of(folder / "missing.yaml"), "file/missing");
  EXPECT_EQ(id_of(folder.path().string()), "file/not-a-file");
  EXPECT_EQ(id_of(folder.write("empty.yaml", "")), "map/wrong-type");
  EXPECT_EQ(id_of(folder.write("list.yaml", "[1, 2]")), "map/wrong-type");
  EXPECT_EQ(id_of(folder.write("long.yaml", std::string(70'000, '#'))), "file/too-large");
  EXPECT_EQ(id_of(folder.write("deep.yaml", std::string(60'000, '['))), "map/syntax");
  EXPECT_EQ(id_of(folder.write("bytes.yaml", "\x01\xff\xfe {")), "map/wrong-type");
  EXPECT_THAT(issues_of(folder / "missing.yaml")[0].expected, "the YAML file of a map");
}

TEST(MapFile, TruncatedOrHugePictures_Refused) {
  const TemporaryFolder folder;
  const std::string yaml = folder.write("map.yaml", description_with());
  const auto refusal = [&](const std::string& picture) {
    folder.write("map.pgm", picture);
    const std::vector<ConfigIssue> issues = issues_of(yaml);
    return issues.size() == 1 && issues[0].id == "map/image" ? issues[0].found : "";
  };
  EXPECT_THAT(refusal("P5\n3 3\n255\n12345678"), HasSubstr("cut short"));
  EXPECT_THAT(refusal("P5\n3"), HasSubstr("cut short"));
  EXPECT_THAT(refusal("P2\n2 2\n255\n0 1 2\n"), HasSubstr("cut short"));
  EXPECT_THAT(refusal("P5\n99999 99999\n255\n0"), HasSubstr("99999 x 99999"));
  EXPECT_THAT(refusal("P5\n0 3\n255\n"), HasSubstr("no pixels"));
  EXPECT_THAT(refusal("P5\n8193 1\n255\n" + std::string(8193, 'x')), HasSubstr("8193 x 1 pixels"));
  EXPECT_THAT(refusal("P5\n2 1\n0\nxx"), HasSubstr("1..65535"));
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
}

}  // namespace
}  // namespace sim::io
