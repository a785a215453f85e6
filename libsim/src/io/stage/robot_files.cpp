// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <set>
#include <utility>

#include "io/stage/translation.h"

namespace sim::io::stage {

void finish_robots(Translation& translation) {
  Json robots = Json::array();
  std::map<std::string, std::string> models;  // text -> file
  std::set<std::string> taken;
  for (RobotDraft& draft : translation.robots) {
    Json model = {{"name", draft.kind}};
    for (auto& [key, value] : draft.model.items()) model[key] = value;
    model["devices"] = draft.devices;
    const std::string text = file_text(model);
    std::string& file = models[text];
    if (file.empty()) {
      std::string stem = draft.kind;
      for (int number = 2; !taken.insert(stem).second; ++number) {
        stem = draft.kind + "_" + std::to_string(number);
      }
      file = stem + ".model.json";
      translation.files[file] = text;
      translation.places[file] = draft.place;
    }
    Json robot;
    robot["name"] = draft.robot["name"];
    robot["model"] = file;
    robot["pose"] = pose_json(draft.X_WB);
    robot["colour"] = to_string(draft.colour);
    for (auto& [key, value] : draft.robot.items()) {
      if (key != "name") robot[key] = value;
    }
    translation.places["/robots/" + std::to_string(robots.size())] = draft.place;
    robots.push_back(std::move(robot));
  }
  translation.world["robots"] = std::move(robots);
}

}  // namespace sim::io::stage
