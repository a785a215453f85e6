// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace PlayerCc {
namespace detail {

/// Tells threads apart: a number that no two of them ever have; 0 for one that has changed nothing
/// yet. Looked at for every beam, so it must not cost a call in a shared library.
#ifdef __ELF__
__attribute__((tls_model("initial-exec")))
#endif
extern __thread std::uint64_t thread_number;

/// Numbers of the newest reading that programs look at one by one: beams. Part of LaserProxy and
/// the like, for this library's own use.
///
/// Written by one thread only, the sole user of the client, and read by it without a lock. When
/// another thread changes anything, this stays as it is, and everybody looks under the client's
/// mutex. See docs/architecture.md.
class Elements {
 public:
  /// As sole_user of a client that has none, or several users.
  static constexpr std::uint64_t kNobody = ~std::uint64_t{0};

  /// Gives a number. False if it is to be looked at under the mutex: there may be none, the calling
  /// thread may not be the sole user, or its looks are to be noted.
  ///
  /// To count each look would take longer than the look. Of looks in ascending order those at every
  /// eighth number are counted, for eight; all others count singly. So looks at whole scans are
  /// counted as often as they are made, and any look counts for eight at most.
  bool Find(std::uint32_t aIndex, double& aValue) {
    if (!IsSoleUser() || aIndex >= mCount) return false;
    if (aIndex <= mLast || aIndex % kCounted == 0) {
      mLooksLeft -= aIndex % kCounted == 0 ? kCounted : 1;
      if (mLooksLeft < 0) return false;
    }
    mLast = aIndex;
    aValue = mValues[aIndex];
    return true;
  }
  /// What the numbers are part of, as given to Show().
  const void* Owner() const { return mOwner.get(); }

  // The rest is called with the client's mutex locked.

  /// Comes before everything else.
  /// @param aSoleUser  the number of the thread that may look without a lock; outlives this.
  void Bind(const std::atomic<std::uint64_t>* aSoleUser) { mSoleUser = aSoleUser; }
  /// What there is to look at from now on. Does nothing unless the calling thread is the sole user.
  void Show(const std::shared_ptr<const void>& aOwner, const double* aValues,
            std::uint32_t aCount) {
    if (!IsSoleUser()) return;
    mOwner = aOwner;
    mValues = aValues;
    mCount = aCount;
  }
  /// How many looks are to be noted when Find() has returned false.
  int Looks() {
    if (!IsSoleUser() || mLooksLeft >= 0) return 1;
    mLooksLeft += kNotedAtOnce;
    return kNotedAtOnce;
  }

 private:
  enum { kCounted = 8, kNotedAtOnce = 1024 };

  bool IsSoleUser() const { return mSoleUser->load(std::memory_order_relaxed) == thread_number; }

  const std::atomic<std::uint64_t>* mSoleUser = nullptr;
  const double* mValues = nullptr;
  std::uint32_t mCount = 0;
  std::uint32_t mLast = 0;  // index of the last look
  int mLooksLeft = kNotedAtOnce;
  std::shared_ptr<const void> mOwner;
};

}  // namespace detail
}  // namespace PlayerCc
