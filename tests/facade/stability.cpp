#include "facade/stability.hpp"

#include <gtest/gtest.h>

namespace vicus {
namespace {

TEST(RulesStability, everyRowIsWithinItsBound) {
  const std::vector<city::StabilityRow> rows = facade::rulesStability();
  EXPECT_GE(rows.size(), 15u);
  for (const city::StabilityRow& row : rows)
    EXPECT_TRUE(row.ok) << row.part << ", " << row.caseName << ": " << row.what << " is " << row.figure
                        << ", and may be " << row.bound << " at most";
}

}  // namespace
}  // namespace vicus
