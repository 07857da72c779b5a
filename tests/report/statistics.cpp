#include "report/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "city/random.hpp"

namespace vicus::report {
namespace {

using Samples = std::vector<double>;

TEST(Median, ByHand) {
  EXPECT_EQ(median(Samples{4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median(Samples{9}), 9);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Mean, ByHand) {
  EXPECT_EQ(mean(Samples{1, 2, 6}), 3);
  EXPECT_TRUE(std::isnan(mean({})));
}

TEST(Bootstrap, TheSameSeedGivesTheSameInterval) {
  const Samples samples{5, 6, 7, 8, 20};
  EXPECT_EQ(medianWithInterval(samples), medianWithInterval(samples));
}

TEST(Bootstrap, AConstantHasNoWidth) {
  EXPECT_EQ(medianWithInterval(Samples{3, 3, 3}), (Estimate{3, 3, 3}));
  EXPECT_EQ(medianWithInterval(Samples{3}), (Estimate{3, 3, 3}));
  EXPECT_TRUE(std::isnan(medianWithInterval({}).value));
}

TEST(Bootstrap, CoversTheTruthAboutAsOftenAsItSays) {
  city::Random random(11);
  int covered = 0;
  const int trials = 200;
  for (int trial = 0; trial < trials; ++trial) {
    Samples samples;
    for (int i = 0; i < 31; ++i) samples.push_back(random.uniform());  // its median is 0.5
    const Estimate estimate = medianWithInterval(samples, {.resamples = 300});
    covered += estimate.low <= 0.5 && 0.5 <= estimate.high ? 1 : 0;
  }
  EXPECT_GE(covered, trials * 88 / 100);
}

TEST(RatioOfMedians, WhatHitsBothAlikeFallsOut) {
  // A machine that slows down threefold on the way, and a configuration that always takes half the time.
  Samples slow, fast;
  for (int i = 0; i < 40; ++i) {
    const double weather = 1 + 2.0 * i / 40;
    slow.push_back(20 * weather);
    fast.push_back(10 * weather);
  }
  const Estimate ratio = ratioOfMedians(slow, fast);
  EXPECT_NEAR(ratio.value, 2, 1e-12);
  EXPECT_NEAR(ratio.low, 2, 1e-9);
  EXPECT_NEAR(ratio.high, 2, 1e-9);
}

TEST(RatioOfMedians, UnevenAndEmptyRuns) {
  EXPECT_EQ(ratioOfMedians(Samples{4, 4, 400}, Samples{2, 2}).value, 2);
  EXPECT_TRUE(std::isnan(ratioOfMedians({}, {}).value));
}

TEST(Agree, Intervals) {
  EXPECT_TRUE(agree({2, 1, 3}, {3.5, 2.9, 4}));
  EXPECT_FALSE(agree({2, 1, 3}, {5, 4, 6}));
}

}  // namespace
}  // namespace vicus::report
