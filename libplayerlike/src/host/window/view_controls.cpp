// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/window/view_controls.h"

#include "sim/core/number_text.h"

namespace playerlike {
namespace {

// X11 keysyms (X.Org, keysymdef.h) of keys without a character.
constexpr std::uint32_t kTab = 0xff09;
constexpr std::uint32_t kEscape = 0xff1b;
constexpr std::uint32_t kLeftArrow = 0xff51;
constexpr std::uint32_t kUpArrow = 0xff52;
constexpr std::uint32_t kRightArrow = 0xff53;
constexpr std::uint32_t kDownArrow = 0xff54;
constexpr std::uint32_t kKeypadPlus = 0xffab;
constexpr std::uint32_t kKeypadMinus = 0xffad;
constexpr std::uint32_t kF1 = 0xffbe;

constexpr double kLeastFactor = 1.0 / 16.0;
constexpr double kGreatestFactor = 64.0;

}  // namespace

std::optional<ViewAction> view_action(std::uint32_t keysym, bool control) noexcept {
  if (control) {
    if (keysym == kUpArrow) return ViewAction::kPreviousMode;
    if (keysym == kDownArrow) return ViewAction::kNextMode;
    return std::nullopt;
  }
  switch (keysym) {
    case 'w':
    case 'W':
    case kUpArrow:
      return ViewAction::kForward;
    case 'x':
    case 'X':
    case kDownArrow:
      return ViewAction::kBackward;
    case 'a':
    case 'A':
    case kLeftArrow:
      return ViewAction::kLeft;
    case 'd':
    case 'D':
    case kRightArrow:
      return ViewAction::kRight;
    case kTab:
      return ViewAction::kNextRobot;
    case ' ':
      return ViewAction::kPause;
    case '+':
    case '=':  // '+' without Shift on keyboards with both on one key
    case kKeypadPlus:
      return ViewAction::kFaster;
    case '-':
    case kKeypadMinus:
      return ViewAction::kSlower;
    case 's':
    case 'S':
      return ViewAction::kSave;
    case 'h':
    case 'H':
    case kF1:
      return ViewAction::kHelp;
    case 'q':
    case 'Q':
    case kEscape:
      return ViewAction::kEnd;
    default:
      return std::nullopt;
  }
}

// Built on each call: the window's thread calls it until the process ends, when static objects may
// be destroyed.
std::vector<std::string> view_help() {
  return {"W A D X, arrows  drive  Tab  next robot  Ctrl+Up, Ctrl+Down  view mode  S  save picture",
          "Space  pause  +, -  speed  H  hide help  Q, Esc  end the run"};
}

double next_time_factor(double factor, bool faster) noexcept {
  const double next = faster ? 2.0 * factor : 0.5 * factor;
  return faster ? (next <= kGreatestFactor ? next : factor)
                : (next >= kLeastFactor ? next : factor);
}

std::string factor_text(double factor) { return "x " + sim::rounded_text(factor, 4); }

void KeyDrive::choose_next(sim::Simulation& simulation) {
  if (chosen_ < 0) return;
  release_all();
  hand_.hand_back(chosen_, simulation);
  chosen_ = hand_.next_drivable(chosen_);
}

void KeyDrive::hold(ViewAction action, bool pressed) {
  held_.at(static_cast<std::size_t>(action)) = pressed;
  if (chosen_ < 0) return;
  const auto direction = [this](ViewAction plus, ViewAction minus) {
    return (held_.at(static_cast<std::size_t>(plus)) ? 1.0 : 0.0) -
           (held_.at(static_cast<std::size_t>(minus)) ? 1.0 : 0.0);
  };
  hand_.steer(chosen_, {.ahead = direction(ViewAction::kForward, ViewAction::kBackward),
                        .left = direction(ViewAction::kLeft, ViewAction::kRight)});
}

void KeyDrive::release_all() {
  held_.fill(false);
  if (chosen_ >= 0) hand_.steer(chosen_, {});
}

}  // namespace playerlike
