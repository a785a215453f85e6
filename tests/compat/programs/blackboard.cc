// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Two robots share the blackboard: the first wanders and writes where it is, the second turns towards
// the newest place that it has heard of.
#include <cstring>
#include <iostream>
#include <libplayerc++/playerc++.h>

using namespace PlayerCc;

static double goal[2];
static int events = 0;

void on_event(playerc_blackboard_t *, player_blackboard_entry_t entry)
{
  if (strcmp(entry.key, "place") != 0 || entry.data_count != sizeof(goal)) return;
  memcpy(goal, entry.data, sizeof(goal));
  events++;
}

int main()
{
  PlayerClient one("localhost", 6665), two("localhost", 6666);
  Position2dProxy pos1(&one, 1), pos2(&two, 1);
  RangerProxy laser1(&one, 0);
  BlackBoardProxy board1(&one, 0), board2(&two, 0);
  board2.SetEventHandler(on_event);
  player_blackboard_entry_t *now = board2.SubscribeToKey("place", "team");
  std::cout << "at first " << now->data_count << " bytes" << std::endl;
  free(now->key);
  free(now->group);
  free(now->data);
  free(now);

  char key[] = "place", group[] = "team";
  double off = 9;
  for (int i = 0; i < 300; i++) {
    one.Read();
    two.Read();
    double nearest = laser1.GetMaxRange();
    for (unsigned int k = 0; k < laser1.GetRangeCount(); k++)
      if (laser1[k] < nearest) nearest = laser1[k];
    pos1.SetSpeed(nearest > 0.8 ? 0.3 : 0, nearest > 0.8 ? 0 : 0.5);

    double place[2] = {pos1.GetXPos(), pos1.GetYPos()};
    player_blackboard_entry_t entry;
    memset(&entry, 0, sizeof(entry));
    entry.key = key;
    entry.key_count = sizeof(key);
    entry.group = group;
    entry.group_count = sizeof(group);
    entry.type = 2;
    entry.data = (uint8_t *)place;
    entry.data_count = sizeof(place);
    board1.SetEntry(entry);

    off = normalize(atan2(goal[1] - pos2.GetYPos(), goal[0] - pos2.GetXPos()) - pos2.GetYaw());
    pos2.SetSpeed(0, limit(2 * off, -1.0, 1.0));
  }
  std::cout << events << " places heard, " << (fabs(off) < 0.05 ? "looks at it" : "looks away")
            << std::endl;
  return 0;
}
