// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace PlayerCc {
namespace detail {

/// Unique number of the calling thread; no other thread ever has it. 0 for a thread that has
/// changed nothing yet. It is read for every beam, so the TLS model avoids a function call in a
/// shared library.
#ifdef __ELF__
__attribute__((tls_model("initial-exec")))
#endif
extern __thread std::uint64_t thread_number;

/// Lock-free access to the elements (beams, coordinates) of the newest reading, which programs read
/// one by one. Part of the proxies; for internal use.
///
/// Only one thread, the sole user of the client, writes this object, and that thread reads it
/// without a lock. Once another thread changes anything, the object is no longer updated, and all
/// threads read under the client's mutex. See docs/architecture.md.
class Elements {
 public:
  /// Value of sole_user for a client with no user or with several users.
  static constexpr std::uint64_t kNobody = ~std::uint64_t{0};

  /// Reads an element. Returns false if the caller must read it under the mutex instead: the
  /// element may not exist, the calling thread may not be the sole user, or accesses have to be
  /// reported.
  ///
  /// Counting every access would cost more than the access itself. Accesses in ascending order are
  /// therefore counted at every eighth index, as eight accesses; all other accesses are counted one
  /// by one. A pass over a whole scan is thus counted exactly, and a single access counts as eight
  /// at most.
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
  /// Reads the number of elements, as Find() reads an element, if there are any. Not counted: who
  /// polls asks for elements, too, because their number and bearings stay the same.
  bool Count(std::uint32_t& aCount) const {
    if (!IsSoleUser() || mCount == 0) return false;
    aCount = mCount;
    return true;
  }
  /// Reads the bearing of an element, as Count() reads their number. Bearings come from a table,
  /// because programs may be compiled with fused multiplication and addition, which would change
  /// the last bit.
  bool Bearing(std::uint32_t aIndex, double& aBearing) const {
    if (!IsSoleUser() || aIndex >= mBearingCount) return false;
    aBearing = mBearings[aIndex];
    return true;
  }
  /// The owner of the elements, as given to Show().
  const void* Owner() const { return mOwner.get(); }

  // The following functions are called with the client's mutex locked.

  /// Must be called before all other functions.
  /// @param aSoleUser  number of the thread that may read without a lock; must outlive this object.
  void Bind(const std::atomic<std::uint64_t>* aSoleUser) { mSoleUser = aSoleUser; }
  /// Whether the calling thread is the sole user, whose calls of Show() and ShowBearings() have an
  /// effect.
  bool MayShow() const { return IsSoleUser(); }
  /// Sets the elements to be read from now on.
  /// @param aFirst, aStep  bearing of element 0, and between neighbours [rad].
  void Show(std::shared_ptr<const void> aOwner, const double* aValues, std::uint32_t aCount,
            double aFirst = 0.0, double aStep = 0.0) {
    if (!IsSoleUser()) return;
    mOwner.swap(aOwner);
    mValues = aValues;
    if (aCount != mCount || aFirst != mFirst || aStep != mStep) mBearingCount = 0;
    mCount = aCount;
    mFirst = aFirst;
    mStep = aStep;
  }
  /// Sets the table of the elements' bearings. It is used until the elements have others.
  void ShowBearings(std::vector<double> aBearings) {
    if (!IsSoleUser() || aBearings.size() != mCount) return;
    mBearings.swap(aBearings);
    mBearingCount = mCount;
  }
  /// Number of accesses to report after Find() has returned false.
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
  std::uint32_t mLast = 0;          // index of the last access
  std::uint32_t mBearingCount = 0;  // 0: there is no table yet
  int mLooksLeft = kNotedAtOnce;
  std::shared_ptr<const void> mOwner;
  std::vector<double> mBearings;
  double mFirst = 0.0;  // see Show()
  double mStep = 0.0;
};

}  // namespace detail
}  // namespace PlayerCc
