// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/window/window.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "sim/core/number_text.h"
#include "sim/world/view_mode.h"

namespace playerlike {

Host::Core::Window::Window(Core& core, int socket) : core_(core), hand_(*core.inputs_.hand) {
  link_ = std::make_unique<ViewerLink>(socket, *this);
}

void Host::Core::Window::close() {
  std::unique_ptr<ViewerLink> link;
  const Lock lock = core_.lock_with_priority();
  std::swap(link, link_);
}

ViewScene Host::Core::Window::view_scene() {
  const Lock lock = core_.lock_with_priority();
  ViewScene view;
  view.scene = core_.results_.scene();
  if (core_.mirror_) core_.mirror_->note_scene_taken();
  view.finished = core_.over();
  view.paused = core_.pace_.paused();
  if (hand_.chosen() >= 0) {
    const auto index = static_cast<std::size_t>(hand_.chosen());
    const sim::Colour colour = core_.robots_[index].colour;
    view.scene.robots[index].marked = true;
    view.robot_colour = static_cast<std::uint32_t>(colour.r) << 16U |
                        static_cast<std::uint32_t>(colour.g) << 8U | colour.b;
    view.status = core_.robots_[index].name + (hand_.active() ? " by hand    " : "    ");
  }
  view.status += "t " + sim::fixed_text(sim::to_seconds(core_.simulation_.now_ns()), 1) + " s    ";
  if (!core_.paced()) view.status += "lockstep    ";
  const bool has_speed = core_.paced() || core_.pace_.watched(core_.simulation_.now_ns());
  view.status += (has_speed ? factor_text(core_.pace_.factor()) : "full speed") + "    ";
  view.status += sim::to_string(core_.simulation_.view_mode());
  if (core_.pace_.paused()) view.status += "    paused";
  if (WallClock::now() < message_end_) view.message = message_;
  if (help_) view.help = view_help();
  return view;
}

std::string Host::Core::Window::on_key(std::uint32_t keysym, bool pressed, bool control) {
  // Ctrl may be pressed between the press and the release of a key.
  const auto action = view_action(keysym, control && pressed);
  if (!action) return "";
  if (*action == ViewAction::kEnd) {
    if (pressed) on_closed();
    return "";
  }
  const Lock lock = core_.lock_with_priority();
  if (*action <= ViewAction::kRight) {
    hand_.hold(*action, pressed);
    core_.driven_by_hand_ = true;
    if (pressed && core_.pace_.paused()) tell("paused: Space continues, and then the robot moves");
    return "";
  }
  if (!pressed) return "";
  if (*action == ViewAction::kSave) return next_picture_file();
  act(*action);
  return "";
}

void Host::Core::Window::act(ViewAction action) {
  switch (action) {
    case ViewAction::kNextMode:
      return change_view_mode(+1);
    case ViewAction::kPreviousMode:
      return change_view_mode(-1);
    case ViewAction::kNextRobot:
      hand_.choose_next(core_.simulation_);
      return;
    case ViewAction::kPause:
      return change_pause();
    case ViewAction::kFaster:
    case ViewAction::kSlower:
      return change_speed(action == ViewAction::kFaster);
    case ViewAction::kHelp:
      help_ = !help_;
      return;
    default:
      return;  // on_key() handles driving, saving and ending
  }
}

void Host::Core::Window::change_view_mode(int by) {
  const auto& modes = sim::kViewModes;
  const auto count = static_cast<int>(modes.size());
  const auto now =
      std::find(modes.begin(), modes.end(), core_.simulation_.view_mode()) - modes.begin();
  const auto next = static_cast<std::size_t>((static_cast<int>(now) + by + count) % count);
  if (const auto refusal = core_.simulation_.set_view_mode(modes.at(next))) tell(*refusal);
}

void Host::Core::Window::change_speed(bool faster) {
  if (core_.mirror_) return tell("speed fixed: a robot mirrors a real one");
  const double factor = next_time_factor(core_.pace_.factor(), faster);
  if (factor == core_.pace_.factor()) {
    return tell(std::string("no ") + (faster ? "faster" : "slower") + " than " +
                factor_text(factor));
  }
  core_.pace_.set_factor(factor);
  core_.changed_.notify_all();
}

void Host::Core::Window::change_pause() {
  core_.pace_.set_paused(!core_.pace_.paused());
  core_.changed_.notify_all();
}

std::string Host::Core::Window::next_picture_file() {
  if (core_.settings_.output_folder.empty()) {
    tell("no picture: the run has no output folder");
    return "";
  }
  std::array<char, 32> name{};
  std::filesystem::path file;
  std::error_code ignored;  // if the folder cannot be checked, writing fails with the reason
  do {
    std::snprintf(name.data(), name.size(), "view_%06d.png", ++pictures_);
    file = std::filesystem::path(core_.settings_.output_folder) / name.data();
  } while (std::filesystem::exists(file, ignored));
  return file.string();
}

void Host::Core::Window::on_shown() {
  if (!core_.mirror_) return;
  const Lock lock = core_.lock_with_priority();
  core_.mirror_->note_scene_shown();
}

void Host::Core::Window::on_keys_released() {
  const Lock lock = core_.lock_with_priority();
  hand_.release_all();
}

void Host::Core::Window::on_saved(const std::string& file, const std::string& problem) {
  const Lock lock = core_.lock_with_priority();
  tell(problem.empty() ? "saved " + std::filesystem::path(file).filename().string() : problem);
}

void Host::Core::Window::on_closed() {
  {
    const Lock lock = core_.lock_with_priority();
    core_.results_.window_closed = true;
  }
  core_.finish();
}

void Host::Core::Window::on_lost(const std::string& reason) {
  const Lock lock = core_.lock_with_priority();
  hand_.release_all();
  if (core_.pace_.paused()) change_pause();
  core_.pace_.stop_watching();
  if (!core_.over())
    core_.warn_("the window is lost (" + reason + "); the run continues without it");
}

void Host::Core::Window::tell(const std::string& text) {
  message_ = text;
  message_end_ = WallClock::now() + std::chrono::seconds(4);
}

}  // namespace playerlike
