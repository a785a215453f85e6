// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "why/reasons_json.h"

#include <nlohmann/json.hpp>

namespace playpen::why {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Reason& reason, const std::string& robot) {
  ordered_json result = {{"kind", reason.kind}, {"time_s", reason.time_s}, {"robot", robot}};
  result["place_m"] = nullptr;
  if (reason.place) result["place_m"] = {reason.place->x(), reason.place->y()};
  result["text"] = reason.text;
  result["numbers"] = ordered_json::object();
  for (const auto& [name, number] : reason.numbers) result["numbers"][name] = number;
  return result;
}

}  // namespace

std::string reasons_json(const std::vector<ExplainedRun>& runs) {
  constexpr int kFormat = 1;
  ordered_json content = {{"format", kFormat}, {"runs", ordered_json::array()}};
  for (const ExplainedRun& run : runs) {
    ordered_json one = {{"folder", run.folder},
                        {"robot", run.robot},
                        {"end_s", run.end_s},
                        {"complete", run.complete}};
    one["passed"] = nullptr;
    if (run.passed) one["passed"] = *run.passed;
    one["faults"] = run.faults;
    one["reasons"] = ordered_json::array();
    for (const Reason& reason : run.reasons) one["reasons"].push_back(json_of(reason, run.robot));
    content["runs"].push_back(std::move(one));
  }
  return content.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace playpen::why
