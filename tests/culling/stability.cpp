#include "culling/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace vicus {
namespace {

TEST(FrustumStability, everyRowIsWithinItsBound) {
  std::set<std::string> parts;
  for (const city::StabilityRow& row : culling::frustumStability()) {
    parts.insert(row.part);
    EXPECT_TRUE(row.ok) << row.part << ", " << row.caseName << ": " << row.what << " is " << row.figure
                        << ", and may be " << row.bound << " at most";
  }
  EXPECT_EQ(parts, (std::set<std::string>{"coordinates", "frustum", "view"}));
}

TEST(FrustumStability, aRowWithNanIsNotOk) {
  EXPECT_FALSE(city::stabilityRow("view", "case", "what", std::nan(""), 1).ok);
  EXPECT_TRUE(city::stabilityRow("view", "case", "what", 1, 1).ok);
  EXPECT_FALSE(city::stabilityRow("view", "case", "what", 1.1, 1).ok);
}

}  // namespace
}  // namespace vicus
