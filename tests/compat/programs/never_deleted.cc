// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Creates client and proxies with new, deletes none of them, and ends by exit().
#include <libplayerc++/playerc++.h>
#include <cstdlib>
using namespace PlayerCc;

int main(int argc, char *argv[])
{
  PlayerClient *client = new PlayerClient("localhost", 6665);
  Position2dProxy *p = new Position2dProxy(client);
  SonarProxy *s = new SonarProxy(client);
  for (int i = 0; ; ++i) {
    client->Read();
    p->SetSpeed(0.25, 0.0);
    if (s->GetCount() > 4 && (*s)[3] < 0.8) break;
    if (i > 500) exit(3);
  }
  p->SetSpeed(0, 0);
  client->Read();
  std::cout << "stopped at " << p->GetXPos() << std::endl;
  exit(0);
}
