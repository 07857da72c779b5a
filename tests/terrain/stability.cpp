#include "terrain/stability.hpp"

#include <gtest/gtest.h>

namespace vicus::terrain {
namespace {

TEST(RoamStability, EveryCaseKeepsItsBound) {
  const std::vector<city::StabilityRow> rows = roamStability();
  EXPECT_GT(rows.size(), 30U);
  for (const city::StabilityRow& row : rows)
    EXPECT_TRUE(row.ok) << row.part << ", " << row.caseName << ": " << row.what << " " << row.figure << " > "
                        << row.bound;
}

}  // namespace
}  // namespace vicus::terrain
