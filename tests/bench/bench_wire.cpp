// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Cost of messages at both ends, without sockets: the answer to a read with a scan of 682 beams, a
// pose and odometry, and a whole canvas of 172 x 186 cells.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "figures.h"
#include "protocol/codec.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"

namespace {

using namespace playerlike::protocol;  // NOLINT(google-build-using-namespace): a small program

struct Round {
  sim::LaserReading scan;
  sim::PoseReading pose;

  Round() {
    // Unlike the standard's distributions, the generator gives the same numbers everywhere.
    std::mt19937_64 random(1);
    const auto number = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    scan.sequence = pose.sequence = 1;
    scan.ranges_m.resize(682);
    for (double& range_m : scan.ranges_m) range_m = 5.0 * number();
    pose.pose = {number(), number(), number()};
    pose.twist = {number(), number(), 0.0};
  }
};

std::string encode_round(const Round& round, Encoding encoding) {
  json answer = {
      {"id", 1}, {"t", 100'000'000}, {"data", true}, {"overflow", 0}, {"finished", false}};
  json& readings = answer["readings"] = json::array();
  readings.push_back(encode_reading({0, 0}, "laser", round.scan, encoding));
  readings.push_back(encode_reading({0, 2}, "odometry", round.pose, encoding));
  readings.push_back(encode_reading({0, 4}, "pose", round.pose, encoding));
  return encode(answer, encoding);
}

void decode_round(const std::string& bytes, Encoding encoding) {
  MessageSplitter splitter(encoding, bytes.size());
  splitter.add(bytes);
  const json answer = decode(splitter.next().value(), encoding);
  for (const json& reading : require(answer, "readings")) {
    benchmark::DoNotOptimize(decode_reading(reading, encoding));
  }
}

std::vector<sim::CellValue> canvas() {
  std::mt19937_64 random(2);
  std::vector<sim::CellValue> cells(std::size_t{172} * 186);
  for (sim::CellValue& cell : cells) cell.bits = static_cast<std::uint32_t>(random());
  return cells;
}

std::string encode_canvas(const std::vector<sim::CellValue>& cells, Encoding encoding) {
  return encode({{"id", 1},
                 {"do", "set_cells"},
                 {"layer", 0},
                 {"rect", {0, 0, 172, 186}},
                 {"cells", encode_cells(cells, encoding)}},
                encoding);
}

void decode_canvas(const std::string& bytes, Encoding encoding) {
  MessageSplitter splitter(encoding, bytes.size());
  splitter.add(bytes);
  const json request = decode(splitter.next().value(), encoding);
  benchmark::DoNotOptimize(decode_cells(require(request, "cells"), encoding));
}

void bm_encode_round(benchmark::State& state, Encoding encoding) {
  const Round round;
  for (auto _ : state) benchmark::DoNotOptimize(encode_round(round, encoding));
}
void bm_decode_round(benchmark::State& state, Encoding encoding) {
  const std::string bytes = encode_round(Round(), encoding);
  for (auto _ : state) decode_round(bytes, encoding);
}
void bm_encode_canvas(benchmark::State& state, Encoding encoding) {
  const std::vector<sim::CellValue> cells = canvas();
  for (auto _ : state) benchmark::DoNotOptimize(encode_canvas(cells, encoding));
}
void bm_decode_canvas(benchmark::State& state, Encoding encoding) {
  const std::string bytes = encode_canvas(canvas(), encoding);
  for (auto _ : state) decode_canvas(bytes, encoding);
}
BENCHMARK_CAPTURE(bm_encode_round, cbor, Encoding::kCbor)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bm_decode_round, cbor, Encoding::kCbor)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bm_encode_round, json, Encoding::kJson)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bm_decode_round, json, Encoding::kJson)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bm_encode_canvas, cbor, Encoding::kCbor)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bm_decode_canvas, cbor, Encoding::kCbor)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bm_encode_canvas, json, Encoding::kJson)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bm_decode_canvas, json, Encoding::kJson)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  const Round round;
  const std::vector<sim::CellValue> cells = canvas();
  for (const Encoding encoding : {Encoding::kCbor, Encoding::kJson}) {
    const std::string name(to_string(encoding));
    const auto both_us = [&](const char* what, auto ends) {
      sim::bench::figure((name + what).c_str(), 1e6 * sim::bench::seconds_per_call(ends, 200));
    };
    both_us("_read_answer_us", [&] { decode_round(encode_round(round, encoding), encoding); });
    both_us("_canvas_us", [&] { decode_canvas(encode_canvas(cells, encoding), encoding); });
  }
  return 0;
}
