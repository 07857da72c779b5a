/// Measuring costs the frame nothing that it could notice: no allocation, whatever is noted.
#include "viewer/measure.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include "viewer/frame_loop.hpp"

namespace {
std::atomic<size_t> allocations{0};  // of this program, by `new`
}  // namespace

void* operator new(size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}

namespace vicus::viewer {
namespace {

TEST(StageSamples, KeepOrderAndNeverAllocate) {
  std::vector<FrameRecord> records;
  records.reserve(100);
  const size_t before = allocations;
  for (int frame = 0; frame < 100; ++frame) {
    FrameRecord record;
    StageClock clock;
    for (const char* name : {"input", "cull map", "apply buildings", "update", "cull", "draw", "finish", "swap"})
      record.stages.add(name, clock.lap());
    records.push_back(record);
  }
  EXPECT_EQ(allocations - before, 0U);
  ASSERT_EQ(records[99].stages.size(), 8U);
  EXPECT_EQ(records[99].stages[1].name, "cull map");
}

TEST(StageSamples, WhatDoesNotFitGoesIntoTheLast) {
  StageSamples samples;
  for (size_t k = 0; k < StageSamples::kMost + 5; ++k) samples.add("stage", 1);
  EXPECT_EQ(samples.size(), StageSamples::kMost);
  double sum = 0;
  for (const StageSample& s : samples) sum += s.milliseconds;
  EXPECT_EQ(sum, static_cast<double>(StageSamples::kMost + 5));
}

TEST(StageClock, LapsAddUp) {
  StageClock whole, parts;
  double sum = 0;
  for (int k = 0; k < 10; ++k) sum += parts.lap();
  EXPECT_LE(sum, whole.lap());
  EXPECT_GE(sum, 0);
}

}  // namespace
}  // namespace vicus::viewer
