// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// One thread reads, another one steers; they share data and protect it with their own mutex.
#include <libplayerc++/playerc++.h>
#include <pthread.h>
using namespace PlayerCc;

static PlayerClient *client;
static Position2dProxy *position;
static LaserProxy *laser;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static double nearest = 10;
static bool quit = false;

static void *reader(void *)
{
  while (true) {
    client->Read();
    double least = 10;
    for (unsigned i = 0; i < laser->GetCount(); ++i) least = std::min(least, (*laser)[i]);
    pthread_mutex_lock(&mutex);
    nearest = least;
    bool done = quit;
    pthread_mutex_unlock(&mutex);
    if (done) return NULL;
  }
}

int main()
{
  client = new PlayerClient("localhost", 6665);
  position = new Position2dProxy(client, 0);
  laser = new LaserProxy(client, 0);
  pthread_t thread;
  pthread_create(&thread, NULL, reader, NULL);
  for (int i = 0; i < 200; ++i) {
    pthread_mutex_lock(&mutex);
    double d = nearest;
    pthread_mutex_unlock(&mutex);
    position->SetSpeed(d < 0.7 ? 0.0 : 0.3, d < 0.7 ? 0.6 : 0.0);
    usleep(100000);
  }
  pthread_mutex_lock(&mutex);
  quit = true;
  pthread_mutex_unlock(&mutex);
  pthread_join(thread, NULL);
  position->SetSpeed(0, 0);
  std::cout << "nearest " << nearest << std::endl;
  return 0;
}
