# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""The rules by which the robots of a made-up class drive, in C.

A rule has constants (name: the values that a student might choose) and the function decide(), which is called for
each scan and ends with a call of drive(v, w). nearest(from, to) is the range to the nearest obstacle between two
angles. Some functions of these exist in several versions, which are in SENSES and DRIVES.
"""

SPEEDS = [0.15, 0.18, 0.2, 0.22, 0.24, 0.25, 0.26, 0.28, 0.3, 0.32, 0.34, 0.35, 0.36, 0.38, 0.4, 0.42]
NEAR = [0.18, 0.2, 0.22, 0.24, 0.25, 0.26, 0.28, 0.3]
CLEAR = [0.35, 0.38, 0.4, 0.42, 0.45, 0.48, 0.5, 0.55, 0.6]
TURNS = [0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2.0]
VIEW = [0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8]
SIDES = [-1, 1]
WALL = [0.16, 0.17, 0.18, 0.19, 0.2, 0.21, 0.22, 0.24, 0.25]

SENSES = [
    ({}, """
static double nearest(double from, double to) {
  double least = 5.0;
  for (int i = 0; i < laser->scan_count; i++) {
    double range = laser->scan[i][0];
    double angle = laser->scan[i][1];
    if (angle >= from && angle <= to && range < least) least = range;
  }
  return least;
}
"""),
    ({}, """
static double nearest(double from, double to) {
  double first = 5.0;
  double second = 5.0;
  for (int i = 0; i < laser->scan_count; i++) {
    double range = laser->scan[i][0];
    double angle = laser->scan[i][1];
    if (angle < from || angle > to) continue;
    if (range < first) {
      second = first;
      first = range;
    } else if (range < second) {
      second = range;
    }
  }
  return second;
}
"""),
    ({"MOST_RANGE": [1.5, 2.0, 2.5, 3.0]}, """
static double least_of_three(double a, double b, double c) {
  double mean = (a + b + c) / 3;
  return mean < MOST_RANGE ? mean : MOST_RANGE;
}

static double nearest(double from, double to) {
  double least = MOST_RANGE;
  for (int i = 1; i + 1 < laser->scan_count; i++) {
    double angle = laser->scan[i][1];
    if (angle < from || angle > to) continue;
    double mean = least_of_three(laser->scan[i - 1][0], laser->scan[i][0], laser->scan[i + 1][0]);
    if (mean < least) least = mean;
  }
  return least;
}
"""),
]

DRIVES = [
    ({}, """
static void drive(double v, double w) { playerc_position2d_set_cmd_vel(position, v, 0, w, 1); }
"""),
    ({"GAIN_OF_SPEED": [0.03, 0.04, 0.05, 0.06]}, """
static double current_speed;

static void drive(double v, double w) {
  if (v > current_speed + GAIN_OF_SPEED) v = current_speed + GAIN_OF_SPEED;
  current_speed = v;
  playerc_position2d_set_cmd_vel(position, v, 0, w, 1);
}
"""),
    ({"SMOOTH": [0.5, 0.55, 0.6, 0.65, 0.7, 0.75]}, """
static double smooth_turn;

static void drive(double v, double w) {
  smooth_turn = SMOOTH * w + (1 - SMOOTH) * smooth_turn;
  playerc_position2d_set_cmd_vel(position, v, 0, smooth_turn, 1);
}
"""),
]

CLAMP = """
static double clamp(double value, double low, double high) {
  return value < low ? low : value > high ? high : value;
}
"""

NORMAL_ANGLE = """
static double normal_angle(double angle) { return atan2(sin(angle), cos(angle)); }
"""

# (name, constants, functions)
RULES = [
    ("hints", {"SPEED": SPEEDS, "NEAR": NEAR, "CLEAR": CLEAR, "TURN": TURNS, "VIEW": VIEW}, """
static int turning;

static void decide(void) {
  double ahead = nearest(-VIEW, VIEW);
  if (turning == 0 && ahead < NEAR) turning = nearest(0, VIEW) < nearest(-VIEW, 0) ? -1 : 1;
  if (ahead > CLEAR) turning = 0;
  drive(turning == 0 ? SPEED : 0, turning * TURN);
}
"""),
    ("one_side", {"SPEED": SPEEDS, "NEAR": NEAR, "CLEAR": CLEAR, "TURN": TURNS, "VIEW": VIEW,
                  "BEND": [0.04, 0.05, 0.06, 0.08, 0.1, 0.12, 0.15], "SIDE": SIDES}, """
static int blocked;

static void decide(void) {
  double ahead = nearest(-VIEW, VIEW);
  if (ahead < NEAR) blocked = 1;
  if (ahead > CLEAR) blocked = 0;
  if (blocked) {
    drive(0, SIDE * TURN);
  } else {
    drive(SPEED, -SIDE * BEND);
  }
}
"""),
    ("sectors", {"SPEED": SPEEDS, "SLOW": [0.05, 0.06, 0.08, 0.1, 0.12], "NEAR": NEAR,
                 "BESIDE": [0.12, 0.14, 0.15, 0.16, 0.18], "TURN": TURNS, "SLIGHT": [0.4, 0.5, 0.6, 0.7, 0.8],
                 "SECTOR": [0.4, 0.45, 0.5, 0.52, 0.55], "SIDE": SIDES}, """
static int last_turn;

static void decide(void) {
  double left = nearest(SECTOR, 3 * SECTOR);
  double middle = nearest(-SECTOR, SECTOR);
  double right = nearest(-3 * SECTOR, -SECTOR);
  if (middle < NEAR) {
    if (last_turn == 0) last_turn = left > right + 0.02 ? 1 : right > left + 0.02 ? -1 : SIDE;
    drive(0, last_turn * TURN);
    return;
  }
  last_turn = 0;
  if (left < BESIDE) {
    drive(SLOW, -SLIGHT);
  } else if (right < BESIDE) {
    drive(SLOW, SLIGHT);
  } else {
    drive(SPEED, 0);
  }
}
"""),
    ("proportional", {"SPEED": SPEEDS, "STOP": [0.1, 0.12, 0.14, 0.15, 0.16, 0.18],
                      "GAIN": [0.6, 0.7, 0.8, 0.9, 1.0, 1.2], "STEER": [0.8, 1.0, 1.2, 1.4, 1.5, 1.6, 1.8, 2.0],
                      "TURN": TURNS, "VIEW": VIEW}, CLAMP + """
static int side;

static void decide(void) {
  double ahead = nearest(-0.5 * VIEW, 0.5 * VIEW);
  double left = nearest(0, 2 * VIEW);
  double right = nearest(-2 * VIEW, 0);
  double v = clamp(GAIN * (ahead - STOP), 0, SPEED);
  if (v < 0.05) {
    if (side == 0) side = left > right ? 1 : -1;
    drive(0, side * TURN);
    return;
  }
  if (v > 0.12) side = 0;
  drive(v, STEER * (left - right) / (left + right) + side * TURN);
}
"""),
    ("field", {"SPEED": SPEEDS, "REACH": [0.4, 0.45, 0.5, 0.55, 0.6, 0.7], "PUSH": [0.5, 0.6, 0.7, 0.8, 0.9, 1.0],
               "STEER": [1.5, 1.8, 2.0, 2.2, 2.5], "CLOSE": NEAR, "TURN": TURNS, "SIDE": SIDES}, CLAMP + """
static int escape;

static void decide(void) {
  double x = 1;
  double y = 0;
  for (int i = 0; i < laser->scan_count; i += 4) {
    double range = laser->scan[i][0];
    double angle = laser->scan[i][1];
    if (range > REACH) continue;
    double push = PUSH * (REACH - range) / REACH * 0.1;
    x -= push * cos(angle);
    y -= push * sin(angle);
  }
  double ahead = nearest(-0.5, 0.5);
  if (ahead < CLOSE && escape == 0) escape = y > 0.02 ? 1 : y < -0.02 ? -1 : SIDE;
  if (ahead > 1.5 * CLOSE) escape = 0;
  if (escape != 0) {
    drive(0, escape * TURN);
  } else {
    double w = clamp(STEER * atan2(y, x), -2.5, 2.5);
    drive(SPEED * clamp(1.2 - fabs(w) / 2, 0.2, 1), w);
  }
}
"""),
    ("wall_p", {"SPEED": SPEEDS, "WALL": WALL, "GAIN": [3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0], "NEAR": NEAR,
                "TURN": TURNS, "SIDE": SIDES}, CLAMP + """
static void decide(void) {
  double ahead = nearest(-0.6, 0.6);
  double beside = SIDE > 0 ? nearest(0.4, 1.6) : nearest(-1.6, -0.4);
  if (ahead < NEAR) {
    drive(0, -SIDE * TURN);
  } else {
    drive(SPEED, SIDE * clamp(GAIN * (beside - WALL), -TURN, TURN));
  }
}
"""),
    ("wall_pd", {"SPEED": SPEEDS, "WALL": WALL, "GAIN": [4.0, 5.0, 6.0, 7.0, 8.0], "DAMP": [0.8, 1.0, 1.2, 1.5, 1.8],
                 "NEAR": NEAR, "TURN": TURNS, "SEARCH": [0.3, 0.4, 0.5, 0.6], "SIDE": SIDES}, CLAMP + """
static double wall_angle(double front, double back) { return atan2(front * 0.707 - back, front * 0.707); }

static void decide(void) {
  double front = SIDE > 0 ? nearest(0.75, 0.82) : nearest(-0.82, -0.75);
  double back = SIDE > 0 ? nearest(1.5, 1.6) : nearest(-1.6, -1.5);
  double ahead = nearest(-0.5, 0.5);
  if (ahead < NEAR) {
    drive(0, -SIDE * TURN);
  } else if (back > 3 * WALL) {
    drive(SPEED * 0.7, SIDE * SEARCH);
  } else {
    double w = GAIN * (back - WALL) + DAMP * wall_angle(front, back);
    drive(SPEED * clamp(2 * (ahead - 0.1), 0.3, 1), SIDE * clamp(w, -2, 2));
  }
}
"""),
    ("wall_switch", {"SPEED": SPEEDS, "TOO_NEAR": [0.12, 0.13, 0.14, 0.15, 0.16], "TOO_FAR": [0.2, 0.22, 0.24, 0.26, 0.28],
                     "CORRECT": [0.3, 0.4, 0.5, 0.6, 0.7, 0.8], "NEAR": NEAR, "CLEAR": CLEAR, "TURN": TURNS,
                     "SIDE": SIDES}, """
static int corner;

static void decide(void) {
  double ahead = nearest(-0.45, 0.45);
  double beside = SIDE > 0 ? nearest(0.6, 1.9) : nearest(-1.9, -0.6);
  if (ahead < NEAR) corner = 1;
  if (ahead > CLEAR) corner = 0;
  if (corner) {
    drive(0, -SIDE * TURN);
  } else if (beside < TOO_NEAR) {
    drive(0.8 * SPEED, -SIDE * CORRECT);
  } else if (beside > TOO_FAR) {
    drive(0.8 * SPEED, SIDE * CORRECT);
  } else {
    drive(SPEED, 0);
  }
}
"""),
    ("longest_beam", {"SPEED": SPEEDS, "STEER": [0.8, 1.0, 1.2, 1.5, 1.8, 2.0], "SEARCH": [0.8, 1.0, 1.2, 1.4, 1.57],
                      "WIDTH": [0.1, 0.12, 0.15, 0.18, 0.2], "NEAR": NEAR, "TURN": TURNS}, CLAMP + """
static int stuck;

static void decide(void) {
  double best = 0;
  double direction = 0;
  for (double angle = -SEARCH; angle <= SEARCH; angle += 0.05) {
    double range = nearest(angle - WIDTH, angle + WIDTH) - 0.1 * fabs(angle);
    if (range > best) {
      best = range;
      direction = angle;
    }
  }
  double ahead = nearest(-0.5, 0.5);
  if (ahead < 0.6 * NEAR) {
    if (stuck == 0) stuck = direction < 0 ? -1 : 1;
    drive(0, stuck * TURN);
    return;
  }
  if (ahead > NEAR) stuck = 0;
  drive(ahead < NEAR ? 0.3 * SPEED : SPEED, clamp(STEER * direction, -TURN, TURN));
}
"""),
    ("widest_gap", {"SPEED": SPEEDS, "DEPTH": [0.4, 0.45, 0.5, 0.6, 0.7, 0.8], "STEER": [0.8, 1.0, 1.2, 1.5, 1.8],
                    "NEAR": NEAR, "TURN": TURNS, "SIDE": SIDES}, CLAMP + """
static int lost;

static double gap_centre(int *found) {
  int best = 0;
  int begin = 0;
  double centre = 0;
  for (int i = 0; i < laser->scan_count; i++) {
    if (laser->scan[i][0] < DEPTH) {
      begin = i + 1;
      continue;
    }
    int width = i - begin;
    if (width > best) {
      best = width;
      centre = laser->scan[begin + width / 2][1];
    }
  }
  *found = best > 20;
  return centre;
}

static void decide(void) {
  int found = 0;
  double centre = gap_centre(&found);
  double ahead = nearest(-0.45, 0.45);
  if (!found || ahead < NEAR) {
    if (lost == 0) lost = !found ? SIDE : centre > 0 ? 1 : -1;
    drive(0, lost * TURN);
    return;
  }
  lost = 0;
  drive(SPEED, clamp(STEER * centre, -TURN, TURN));
}
"""),
    ("random_turns", {"SPEED": SPEEDS, "NEAR": NEAR, "TURN": TURNS, "VIEW": VIEW, "FIRST": list(range(3, 400, 7)),
                      "LEAST": list(range(5, 12)), "SPREAD": list(range(8, 20))}, """
static unsigned number;
static int steps;
static int way;

static int draw(int below) {
  number = number * 1103515245u + 12345u + (unsigned)FIRST;
  return (int)((number >> 16) % (unsigned)below);
}

static void decide(void) {
  if (steps == 0 && nearest(-VIEW, VIEW) < NEAR) {
    steps = LEAST + draw(SPREAD);
    way = draw(2) == 0 ? -1 : 1;
  }
  if (steps > 0) {
    steps--;
    drive(0, way * TURN);
  } else {
    drive(SPEED, 0);
  }
}
"""),
    ("compass", {"SPEED": SPEEDS, "NEAR": NEAR, "STEP": [0.7, 0.785, 0.9, 1.05, 1.2, 1.4, 1.57], "STEER": [1.5, 1.8, 2.0, 2.5, 3.0],
                 "ALIGNED": [0.1, 0.12, 0.15, 0.2, 0.25], "VIEW": VIEW}, CLAMP + NORMAL_ANGLE + """
static int begun;
static double target;

static void decide(void) {
  if (!begun) target = position->pa;
  begun = 1;
  double error = normal_angle(target - position->pa);
  if (fabs(error) < ALIGNED && nearest(-VIEW, VIEW) < NEAR) {
    target += nearest(0, 1.8) > nearest(-1.8, 0) ? STEP : -STEP;
    error = normal_angle(target - position->pa);
  }
  drive(fabs(error) < 2 * ALIGNED ? SPEED : 0, clamp(STEER * error, -2, 2));
}
"""),
    ("back_up", {"SPEED": SPEEDS, "NEAR": NEAR, "BACK": [0.1, 0.12, 0.14, 0.15, 0.16, 0.18, 0.2], "TURN": TURNS,
                 "VIEW": VIEW, "BACK_STEPS": list(range(4, 12)), "TURN_STEPS": list(range(7, 22)), "SIDE": SIDES}, """
static int phase;

static void decide(void) {
  if (phase == 0 && nearest(-VIEW, VIEW) < NEAR) phase = BACK_STEPS + TURN_STEPS;
  if (phase > TURN_STEPS) {
    drive(-BACK, 0);
  } else if (phase > 0) {
    drive(0, SIDE * TURN);
  } else {
    drive(SPEED, 0);
  }
  if (phase > 0) phase--;
}
"""),
    ("arcs", {"SPEED": SPEEDS, "BEND": [0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6], "PERIOD": list(range(20, 70, 3)), "NEAR": NEAR,
              "CLEAR": CLEAR, "TURN": TURNS, "VIEW": VIEW, "SIDE": SIDES}, """
static int tick;
static int away;

static void decide(void) {
  double ahead = nearest(-VIEW, VIEW);
  tick++;
  if (away == 0 && ahead < NEAR) away = nearest(0, 1.2) > nearest(-1.2, 0) ? 1 : -1;
  if (ahead > CLEAR) away = 0;
  if (away != 0) {
    drive(0, away * TURN);
  } else {
    drive(SPEED, tick / PERIOD % 2 == 0 ? SIDE * BEND : -SIDE * BEND);
  }
}
"""),
    ("window", {"SPEED": SPEEDS, "HORIZON": [0.8, 0.9, 1.0, 1.1, 1.2, 1.4, 1.5], "WIDTH": [0.1, 0.11, 0.12, 0.13],
                "TURN": TURNS, "STRAIGHT": [0.02, 0.03, 0.04, 0.05, 0.06], "SIDE": SIDES}, """
static int rotating;

static double free_time(double w) {
  double x = 0;
  double y = 0;
  double yaw = 0;
  for (double time = 0; time < HORIZON; time += 0.15) {
    x += 0.15 * SPEED * cos(yaw);
    y += 0.15 * SPEED * sin(yaw);
    yaw += 0.15 * w;
    for (int i = 0; i < laser->scan_count; i += 5) {
      double dx = laser->scan[i][0] * cos(laser->scan[i][1]) + 0.035 - x;
      double dy = laser->scan[i][0] * sin(laser->scan[i][1]) - y;
      if (dx * dx + dy * dy < WIDTH * WIDTH) return time;
    }
  }
  return HORIZON;
}

static void decide(void) {
  double best = -1;
  double turn = 0;
  for (int k = -6; k <= 6; k++) {
    double w = SIDE * k * TURN / 6;
    double value = free_time(w) - STRAIGHT * fabs(w);
    if (value > best) {
      best = value;
      turn = w;
    }
  }
  if (best < 0.4 * HORIZON) {
    if (rotating == 0) rotating = turn == 0 ? SIDE : turn > 0 ? 1 : -1;
    drive(0, rotating * TURN);
  } else {
    rotating = 0;
    drive(SPEED, turn);
  }
}
"""),
    ("histogram", {"SPEED": SPEEDS, "CELL": [0.15, 0.17, 0.2, 0.22, 0.25], "FREE": [0.3, 0.32, 0.35, 0.38, 0.4, 0.45],
                   "STEER": [1.2, 1.5, 1.8, 2.0, 2.2], "NEAR": [0.16, 0.18, 0.2, 0.22], "TURN": TURNS, "SIDE": SIDES}, CLAMP + """
static double wanted;

static void decide(void) {
  double best = 100;
  double chosen = SIDE * 2.0;
  for (int k = -7; k <= 7; k++) {
    double angle = SIDE * k * CELL;
    if (nearest(angle - CELL, angle + CELL) < FREE) continue;
    double cost = fabs(angle - 0.5 * wanted) + 0.3 * fabs(angle);
    if (cost < best) {
      best = cost;
      chosen = angle;
    }
  }
  wanted = chosen;
  double ahead = nearest(-0.45, 0.45);
  if (ahead < NEAR || fabs(chosen) > 1.2) {
    drive(0, chosen > 0 ? TURN : -TURN);
  } else {
    drive(SPEED * (1 - 0.4 * fabs(chosen)), clamp(STEER * chosen, -TURN, TURN));
  }
}
"""),
    ("visits", {"SPEED": SPEEDS, "CELL": [0.2, 0.25, 0.3, 0.35, 0.4], "NEED": [0.35, 0.4, 0.45, 0.5], "STEER": [1.5, 1.8, 2.0, 2.5],
                "NEAR": NEAR, "TURN": TURNS, "PATIENCE": list(range(15, 45, 3))}, CLAMP + NORMAL_ANGLE + """
static int visits[64][64];
static double course;
static int age;

static int *cell_at(double x, double y) {
  int column = (int)(x / CELL) + 32;
  int row = (int)(y / CELL) + 32;
  return &visits[column & 63][row & 63];
}

static void choose(void) {
  double best = 1e9;
  for (int k = 0; k < 12; k++) {
    double angle = normal_angle(k * 0.5236);
    double yaw = position->pa + angle;
    double room = fabs(angle) < 1.7 ? nearest(angle - 0.25, angle + 0.25) : 0.3;
    double cost = *cell_at(position->px + NEED * cos(yaw), position->py + NEED * sin(yaw)) + 2 * fabs(angle);
    if (room < NEED) cost += 500;
    if (cost < best) {
      best = cost;
      course = yaw;
    }
  }
  age = 0;
}

static void decide(void) {
  ++*cell_at(position->px, position->py);
  double ahead = nearest(-0.5, 0.5);
  double error = normal_angle(course - position->pa);
  if (age++ > PATIENCE || (ahead < NEAR && fabs(error) < 0.2)) choose();
  error = normal_angle(course - position->pa);
  drive(fabs(error) > 0.5 || ahead < 0.7 * NEAR ? 0 : SPEED, clamp(STEER * error, -TURN, TURN));
}
"""),
    ("centre", {"SPEED": SPEEDS, "GAIN": [1.5, 1.8, 2.0, 2.5, 3.0], "CAP": [0.35, 0.4, 0.45, 0.5, 0.6], "NEAR": NEAR,
                "TURN": TURNS, "UTURN": [1.8, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0]}, CLAMP + NORMAL_ANGLE + """
static int turning_back;
static double goal_yaw;

static void decide(void) {
  double left = clamp(nearest(0.7, 1.8), 0, CAP);
  double right = clamp(nearest(-1.8, -0.7), 0, CAP);
  double ahead = nearest(-0.5, 0.5);
  if (turning_back) {
    double error = normal_angle(goal_yaw - position->pa);
    if (fabs(error) < 0.15) turning_back = 0;
    drive(0, clamp(3 * error, -TURN, TURN));
  } else if (ahead < NEAR) {
    turning_back = 1;
    goal_yaw = position->pa + (left > right ? 1 : -1) * (left + right > 1.5 * CAP ? 0.6 * UTURN : UTURN);
    drive(0, 0);
  } else {
    drive(SPEED * clamp(3 * (ahead - 0.1), 0.3, 1), clamp(GAIN * (left - right), -TURN, TURN));
  }
}
"""),
    ("billiard", {"SPEED": SPEEDS, "NEAR": NEAR, "STEER": [1.8, 2.0, 2.5, 3.0], "TURN": TURNS, "VIEW": VIEW,
                  "EXTRA": [0.05, 0.1, 0.15, 0.2, 0.25, 0.3], "SIDE": SIDES}, CLAMP + NORMAL_ANGLE + """
static int reflecting;
static double outgoing;

static double obstacle_angle(void) {
  double least = 100;
  double angle = 0;
  for (int i = 0; i < laser->scan_count; i++) {
    if (fabs(laser->scan[i][1]) > 1.4 || laser->scan[i][0] >= least) continue;
    least = laser->scan[i][0];
    angle = laser->scan[i][1];
  }
  return angle;
}

static void decide(void) {
  if (!reflecting && nearest(-VIEW, VIEW) < NEAR) {
    double angle = obstacle_angle();
    double side = fabs(angle) < 0.05 ? SIDE : angle > 0 ? -1 : 1;
    outgoing = position->pa + side * (3.1416 - 2 * fabs(angle)) * 0.6 + side * EXTRA;
    reflecting = 1;
  }
  if (reflecting) {
    double error = normal_angle(outgoing - position->pa);
    if (fabs(error) < 0.1) reflecting = 0;
    drive(0, clamp(STEER * error, -TURN, TURN));
  } else {
    drive(SPEED, 0);
  }
}
"""),
    ("pledge", {"SPEED": SPEEDS, "WALL": WALL, "GAIN": [3.0, 4.0, 5.0, 6.0], "NEAR": NEAR, "TURN": TURNS,
                "SIDE": SIDES, "LEAVE": [0.1, 0.15, 0.2, 0.3]}, CLAMP + NORMAL_ANGLE + """
static int following;
static double turned;
static double last_yaw;

static void decide(void) {
  double ahead = nearest(-0.55, 0.55);
  double beside = SIDE > 0 ? nearest(0.5, 1.7) : nearest(-1.7, -0.5);
  turned += normal_angle(position->pa - last_yaw);
  last_yaw = position->pa;
  if (!following && ahead < NEAR) {
    following = 1;
    turned = 0;
  } else if (following && SIDE * turned > LEAVE) {
    following = 0;
  }
  if (ahead < NEAR) {
    drive(0, -SIDE * TURN);
  } else if (following) {
    drive(SPEED, SIDE * clamp(GAIN * (beside - WALL), -1.5, 1.5));
  } else {
    drive(SPEED, 0);
  }
}
"""),
]
