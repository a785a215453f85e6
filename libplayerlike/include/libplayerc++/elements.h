// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
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
/// One thread at a time, the holder, may read without a lock: the thread that changed something
/// last. Each of two threads has a view of its own, which no other thread reads or writes; so a
/// thread that was the holder a moment ago still reads a snapshot that nobody changes. Other
/// threads read under the client's mutex. See docs/architecture.md.
class Elements {
 public:
  enum { kViews = 2 };
  /// A thread_number that no thread has.
  static constexpr std::uint64_t kNobody = ~std::uint64_t{0};
  /// The holder of a client.
  struct Holder {
    std::uint64_t mThread = kNobody;  ///< its thread_number
    std::size_t mView = kViews;       ///< index of its view
  };

  /// Reads an element. Returns false if the caller must read it under the mutex instead: the
  /// element may not exist, the calling thread may not be the holder, or accesses have to be
  /// reported.
  ///
  /// Counting every access would cost more than the access itself. Accesses in ascending order are
  /// therefore counted at every eighth index, as eight accesses; all other accesses are counted one
  /// by one. A pass over a whole scan is thus counted exactly, and a single access counts as eight
  /// at most.
  bool Find(std::uint32_t aIndex, double& aValue) {
    const void* owner = nullptr;
    return Find(aIndex, aValue, owner);
  }
  /// As above; also reads the owner of the elements, as given to Show().
  bool Find(std::uint32_t aIndex, double& aValue, const void*& aOwner) {
    View* const own = Own();
    if (own == nullptr || aIndex >= own->mCount) return false;
    aOwner = own->mOwner.get();
    if (aIndex <= own->mLast || aIndex % kCounted == 0) {
      own->mLooksLeft -= aIndex % kCounted == 0 ? kCounted : 1;
      if (own->mLooksLeft < 0) return false;
    }
    own->mLast = aIndex;
    aValue = own->mValues[aIndex];
    return true;
  }
  /// Reads the number of elements, as Find() reads an element, if there are any. Not counted: who
  /// polls asks for elements, too, because their number and bearings stay the same.
  bool Count(std::uint32_t& aCount) const {
    const View* const own = Own();
    if (own == nullptr || own->mCount == 0) return false;
    aCount = own->mCount;
    return true;
  }
  /// Reads the owner of the elements, as Count() reads their number.
  bool Owner(const void*& aOwner) const {
    const View* const own = Own();
    if (own == nullptr || own->mCount == 0) return false;
    aOwner = own->mOwner.get();
    return true;
  }
  /// Reads the bearing of an element, as Count() reads their number. Bearings come from a table,
  /// because programs may be compiled with fused multiplication and addition, which would change
  /// the last bit.
  bool Bearing(std::uint32_t aIndex, double& aBearing) const {
    const View* const own = Own();
    if (own == nullptr || aIndex >= own->mBearingCount) return false;
    aBearing = own->mBearings[aIndex];
    return true;
  }

  // The following functions are called with the client's mutex locked.

  /// Must be called before all other functions.
  /// @param aHolder  must outlive this object.
  void Bind(const Holder* aHolder) { mHolder = aHolder; }
  /// The index of the view that belongs to the calling thread, if it is the holder, so that its
  /// calls of Show() and ShowBearings() have an effect; otherwise kViews.
  std::size_t ViewToShow() const {
    return mHolder->mThread == thread_number ? mHolder->mView : std::size_t{kViews};
  }
  /// From now on all threads must read under the mutex, until the next Show().
  void Withdraw() {
    for (View& view : mViews) view.mReader.store(kNobody, std::memory_order_relaxed);
  }
  /// Sets the elements that the calling thread reads from now on.
  /// @param aFirst, aStep  bearing of element 0, and between neighbours [rad].
  void Show(std::shared_ptr<const void> aOwner, const double* aValues, std::uint32_t aCount,
            double aFirst = 0.0, double aStep = 0.0) {
    const std::size_t index = ViewToShow();
    if (index == kViews) return;
    View& own = mViews[index];
    own.mOwner.swap(aOwner);
    own.mValues = aValues;
    if (aCount != own.mCount || aFirst != own.mFirst || aStep != own.mStep) own.mBearingCount = 0;
    own.mCount = aCount;
    own.mFirst = aFirst;
    own.mStep = aStep;
    own.mReader.store(thread_number, std::memory_order_relaxed);
    mNewest.store(&own, std::memory_order_relaxed);
  }
  /// Sets the table of the elements' bearings. It is used until the elements have others.
  void ShowBearings(std::vector<double> aBearings) {
    View* const own = Own();
    if (own == nullptr || aBearings.size() != own->mCount) return;
    own->mBearings.swap(aBearings);
    own->mBearingCount = own->mCount;
  }
  /// Number of accesses to report after Find() has returned false.
  int Looks() {
    View* const own = Own();
    if (own == nullptr || own->mLooksLeft >= 0) return 1;
    own->mLooksLeft += kNotedAtOnce;
    return kNotedAtOnce;
  }

 private:
  enum { kCounted = 8, kNotedAtOnce = 1024 };

  /// What one thread reads without a lock.
  struct View {
    std::atomic<std::uint64_t> mReader{kNobody};  ///< thread_number of who may read it
    const double* mValues = nullptr;
    std::uint32_t mCount = 0;
    std::uint32_t mLast = 0;          ///< index of the last access
    std::uint32_t mBearingCount = 0;  ///< 0: there is no table yet
    int mLooksLeft = kNotedAtOnce;
    std::shared_ptr<const void> mOwner;
    std::vector<double> mBearings;
    double mFirst = 0.0;  ///< see Show()
    double mStep = 0.0;
  };

  /// The view of the calling thread; null if it may not read without the mutex. The other view has
  /// no reader: it was withdrawn before this one was shown.
  View* Own() const {
    View* const newest = mNewest.load(std::memory_order_relaxed);
    return newest->mReader.load(std::memory_order_relaxed) == thread_number ? newest : nullptr;
  }

  const Holder* mHolder = nullptr;
  mutable View mViews[kViews];
  mutable std::atomic<View*> mNewest{mViews};  ///< the view of the last call of Show()
};

}  // namespace detail
}  // namespace PlayerCc
