// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A plain client that reads once and prints the shared libraries that its process has loaded.
#include <libplayerc++/playerc++.h>
#include <link.h>

#include <iostream>

namespace {

int print(dl_phdr_info* info, std::size_t /*size*/, void* count) {
  if (info->dlpi_name[0] == '\0') return 0;  // the program itself
  ++*static_cast<int*>(count);
  std::cout << info->dlpi_name << '\n';
  return 0;
}

}  // namespace

int main() {
  PlayerCc::PlayerClient client("localhost", 6665);
  PlayerCc::Position2dProxy position(&client, 0);
  client.Read();
  position.SetSpeed(0.1, 0.0);
  int count = 0;
  dl_iterate_phdr(&print, &count);
  std::cout << "libraries " << count << '\n';
}
