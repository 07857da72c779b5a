#include "assets/import/import_stability.hpp"

#include <gtest/gtest.h>

namespace vicus::assets {
namespace {

TEST(ImportStability, EveryRowIsWithinItsBound) {
  const auto rows = importStability();
  EXPECT_GE(rows.size(), 8u);
  for (const city::StabilityRow& row : rows)
    EXPECT_TRUE(row.ok) << row.part << ", " << row.caseName << ": " << row.figure << " over " << row.bound << " ("
                        << row.what << ")";
}

}  // namespace
}  // namespace vicus::assets
