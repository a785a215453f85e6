// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

const double MAX_SPEED = 0.5;  // limits of the S1R [m/s]
const double MAX_TURN = 3.0;   // [rad/s]

const double REACH = 0.40;   // farther obstacles cannot be touched within a rollout [m]
const double MARGIN = 0.02;  // clearance to keep round the robot [m]
const double TIGHT = 0.015;  // with less clearance, the robot first gets out of there [m] ...
const double ENOUGH = 0.04;  // ... until it has this much [m]
const double SAME = 0.002;   // smaller changes do not count as coming nearer [m]

// With enough room: a command lasts 0.1 s, so the horizon covers a few iterations of the program.
const double HORIZON = 0.4;  // [s]
const double STEP = 0.05;    // [s]; 2.5 cm at full speed
const double SLOW = 0.10;    // speed limit at the smallest clearance [m/s],
const double GAIN = 3.0;     // and its increase per metre of clearance [1/s]

// In a tight place: a curve away from a wall first swings the tail towards the wall, so its outcome
// shows late.
const double TIGHT_HORIZON = 1.5;  // [s]
const double TIGHT_STEP = 0.1;     // [s]
const double DIP = 0.0015;         // a curve may temporarily come nearer by this [m]
const double TOUCH = 0.002;        // but never as near as this [m]

// A straight side of the robot: points p with nx px + ny py > d are outside of it.
struct Side {
  double nx;
  double ny;
  double d;
};

// The S1R's outline is an octagon centred on the middle of its axle: 0.087 m to the front and the
// back, 0.081 m to the sides, with corners at (0.087, 0.045), (0.050, 0.081) and their mirror
// images.
std::vector<Side> makeOutline() {
  const double dx = 0.087 - 0.050;
  const double dy = 0.081 - 0.045;
  const double nx = dy / std::hypot(dx, dy);  // normal of the side between these two corners
  const double ny = dx / std::hypot(dx, dy);
  const double d = nx * 0.087 + ny * 0.045;
  return {{1, 0, 0.087}, {-1, 0, 0.087}, {0, 1, 0.081}, {0, -1, 0.081},
          {nx, ny, d},   {nx, -ny, d},   {-nx, ny, d},  {-nx, -ny, d}};
}

double distanceTo(const par::Point& p) {
  static const std::vector<Side> outline = makeOutline();
  double outside = -std::numeric_limits<double>::infinity();
  for (const Side& side : outline) {
    outside = std::max(outside, side.nx * p.x + side.ny * p.y - side.d);
  }
  return outside;
}

// The clearance after the robot has driven a command for some time, along a circular arc from its
// current pose.
double clearanceAfter(const par::Velocity& command, double time,
                      const std::vector<par::Point>& points) {
  const double turned = command.turn_radps * time;
  const double straight = command.forward_mps * time;
  const double chord =
      std::fabs(turned) < 1e-6 ? straight : straight * std::sin(0.5 * turned) / (0.5 * turned);
  const double x = chord * std::cos(0.5 * turned);
  const double y = chord * std::sin(0.5 * turned);
  const double c = std::cos(turned);
  const double s = std::sin(turned);
  double least = std::numeric_limits<double>::infinity();
  for (const par::Point& p : points) {
    const double dx = p.x - x;
    const double dy = p.y - y;
    least = std::min(least, distanceTo({c * dx + s * dy, -s * dx + c * dy}));
  }
  return least;
}

bool keeps(double room, const par::Velocity& command, const std::vector<par::Point>& points) {
  for (double t = STEP; t < HORIZON + 0.5 * STEP; t += STEP) {
    if (clearanceAfter(command, t, points) < room) return false;
  }
  return true;
}

std::vector<par::Point> within(double reach, const std::vector<par::Point>& points) {
  std::vector<par::Point> result;
  for (const par::Point& p : points) {
    if (std::hypot(p.x, p.y) < reach) result.push_back(p);
  }
  return result;
}

double clamp(double value, double low, double high) { return std::max(low, std::min(high, value)); }

bool is_moving(const par::Velocity& command) {
  return command.forward_mps != 0.0 || command.turn_radps != 0.0;
}

// The command that leads to the largest clearance without touching anything on the way.
par::Velocity getOut(double now, const Surroundings& around) {
  const double unseenNow = clearance(around.unseen);
  par::Velocity best;
  double bestWorth = SAME;  // a smaller gain is not worth moving
  for (const double v : {0.15, 0.08, 0.04, 0.0, -0.04, -0.08}) {
    for (const double w : {0.0, 0.1, -0.1, 0.2, -0.2, 0.4, -0.4, 0.8, -0.8, 1.6, -1.6}) {
      double least = now;
      double unseenLeast = unseenNow;
      double room = now;
      for (double t = TIGHT_STEP; t < TIGHT_HORIZON + 0.5 * TIGHT_STEP; t += TIGHT_STEP) {
        room = clearanceAfter({v, w}, t, around.solid);
        least = std::min(least, room);
        unseenLeast = std::min(unseenLeast, clearanceAfter({v, w}, t, around.unseen));
        if (least < std::min(now, std::max(now - DIP, TOUCH))) break;
      }
      if (least < std::min(now, std::max(now - DIP, TOUCH))) continue;
      const double blind = unseenLeast < std::min(MARGIN, unseenNow) - SAME ? 0.5 : 1.0;
      const double worth = blind * (std::min(room, ENOUGH + MARGIN) - now);
      if (worth <= bestWorth) continue;
      best = {v, w};
      bestWorth = worth;
    }
  }
  return best;
}

// The command closest to the wanted one that keeps the required clearance; zero if there is none.
par::Velocity mostLike(const par::Velocity& wanted, double now, const Surroundings& around) {
  const double limit = std::min(MAX_SPEED, SLOW + GAIN * std::max(0.0, now - MARGIN));
  const double forward = std::min(wanted.forward_mps, limit);
  struct Choice {
    par::Velocity command;
    double price;
  };
  std::vector<Choice> choices;
  const auto consider = [&](double v, double w) {
    const par::Velocity command = {v, clamp(w, -MAX_TURN, MAX_TURN)};
    const double price = std::fabs(v - forward) / MAX_SPEED +
                         0.5 * std::fabs(command.turn_radps - wanted.turn_radps) / MAX_TURN;
    if (is_moving(command)) choices.push_back({command, price});
  };
  for (const double v : {forward, 0.6 * forward, 0.3 * forward, 0.0, std::min(limit, 0.08)}) {
    for (const double off : {0.0, 0.4, -0.4, 0.9, -0.9, 1.6, -1.6}) {
      consider(v, wanted.turn_radps + off);
    }
    consider(v, 0.0);
  }
  std::stable_sort(choices.begin(), choices.end(),
                   [](const Choice& a, const Choice& b) { return a.price < b.price; });

  // If the clearance is already smaller than required, it is enough not to come nearer.
  const double room = std::min(MARGIN, now - SAME);
  const double unseenRoom = std::min(MARGIN, clearance(around.unseen) - SAME);
  for (const bool careful : {true, false}) {
    for (const Choice& choice : choices) {
      if (keeps(room, choice.command, around.solid) &&
          (!careful || keeps(unseenRoom, choice.command, around.unseen))) {
        return choice.command;
      }
    }
  }
  return {};
}

}  // namespace

double clearance(const std::vector<par::Point>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const par::Point& p : points) least = std::min(least, distanceTo(p));
  return least;
}

par::Velocity CGuard::check(const par::Velocity& wanted, const Surroundings& around) {
  if (wanted.forward_mps == 0.0 && wanted.turn_radps == 0.0) return wanted;

  const Surroundings near = {within(REACH, around.solid), within(REACH, around.unseen)};
  const double now = clearance(near.solid);
  gettingOut = now < (gettingOut ? ENOUGH : TIGHT);
  if (gettingOut) {
    const par::Velocity out = getOut(now, near);
    if (is_moving(out)) return out;
    gettingOut = false;
  }
  const par::Velocity most = mostLike(wanted, now, near);
  if (is_moving(most) || now >= ENOUGH) return most;
  // There is a little room, but not enough for the wanted command, for example to turn on the spot.
  const par::Velocity out = getOut(now, near);
  gettingOut = is_moving(out);
  return out;
}
