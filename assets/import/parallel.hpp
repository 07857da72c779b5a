/// Work on many independent items at once, results in the items' own order.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace vicus::assets {

/// Calls `body(i)` once for each i in 0 … count−1, from as many threads as the machine has cores; `grain` (≥ 1) items
/// are taken at a time. Returns when all are done. `body` writes only to what belongs to item i, so that the result is
/// the same for every thread count. The first exception that a body throws is thrown again here.
template <typename Body>
void parallelFor(size_t count, size_t grain, const Body& body) {
  const size_t blocks = (count + grain - 1) / grain;
  const size_t threads = std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()), blocks);
  std::atomic<size_t> next{0};
  std::exception_ptr failure;
  std::mutex failureMutex;
  const auto work = [&] {
    try {
      for (size_t block = next++; block < blocks; block = next++)
        for (size_t i = block * grain; i < std::min(count, (block + 1) * grain); ++i) body(i);
    } catch (...) {
      const std::scoped_lock lock(failureMutex);
      if (!failure) failure = std::current_exception();
      next = blocks;
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (size_t t = 1; t < threads; ++t) helpers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace vicus::assets
