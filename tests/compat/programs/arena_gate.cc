// Opens the gate of its arena, waits until it has sunk, and drives through to the goal.
#include <libCCMorse/CCMorse.h>
#include <iostream>
#include <string>
#include <vector>
using namespace CCMorse;
using namespace std;

int main()
{
  PlayerClient robot("localhost", 6665);
  Position2dProxy motors(&robot, 0);
  ArenaProxy arena(&robot);
  cout << arena.GetConfigurationCount() << " configurations, the last is "
       << arena.GetConfigurationName(arena.GetConfigurationCount() - 1) << endl;
  try {
    arena.SetConfiguration("opened");
  } catch (const MorseError &e) {
    cout << e.GetErrorStr() << endl;
  }
  arena.DisableTimer("opening");
  arena.SetConfiguration("open");
  cout << "gate: " << arena.GetBlockState("gate") << endl;
  try {
    robot.Read();
    while (arena.GetBlockState("gate") != "retracted") robot.Read();
    cout << "gate: " << arena.GetBlockHeight("gate") << " m high" << endl;
    motors.SetSpeed(0.4, 0);
    for (;;) robot.Read();
  } catch (const MorseError &e) {
    if (e.GetErrorCode() != MorseError::kRunIsOver) throw;
  }
  vector<ArenaEvent> events = arena.GetEvents();
  for (size_t i = 0; i < events.size(); i++) {
    cout << events[i].time << " " << events[i].kind << " " << events[i].what << endl;
  }
  cout << arena.GetScore("runner") << " points" << endl;
  if (!arena.HasVerdict()) return 1;
  cout << "verdict: " << arena.GetVerdict().reason << endl;
  return arena.GetVerdict().passed && arena.GetLostEventCount() == 0 ? 0 : 1;
}
