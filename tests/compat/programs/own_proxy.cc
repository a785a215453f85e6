// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Derives from Player's classes and uses their protected members.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;

class CountingLaser : public LaserProxy {
 public:
  CountingLaser(PlayerClient *pc, uint32_t index) : LaserProxy(pc, index), count_(0) {}
  bool take()
  {
    bool fresh = GetVar(mFresh);
    if (fresh) {
      NotFresh();
      count_++;
    }
    return fresh;
  }
  int count() const { return count_; }
  bool has_client() const { return mPc != NULL && mPc->Connected(); }

 private:
  int count_;
};

class Nothing : public ClientProxy {
 public:
  Nothing(PlayerClient *pc, uint32_t index) : ClientProxy(pc, index) { Subscribe(index); }
  ~Nothing() { Unsubscribe(); }

 private:
  void Subscribe(uint32_t index) { ClientProxy::Subscribe(index); }
  void Unsubscribe() { ClientProxy::Unsubscribe(); }
};

int main()
{
  PlayerClient robot("localhost");
  CountingLaser laser(&robot, 0);
  Nothing nothing(&robot, 3);
  for (int i = 0; i < 50; ++i) {
    robot.Read();
    laser.take();
  }
  std::cout << laser.count() << " scans; " << nothing << std::endl;
  return laser.has_client() && laser.count() >= 49 && nothing.GetIndex() == 3 ? 0 : 1;
}
