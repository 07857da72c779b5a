#include "avatars/stability.hpp"

#include <gtest/gtest.h>

namespace vicus::avatars {
namespace {

TEST(AvatarStability, EveryCaseKeepsItsBound) {
  const std::vector<city::StabilityRow> rows = avatarStability();
  EXPECT_GT(rows.size(), 15U);
  for (const city::StabilityRow& row : rows)
    EXPECT_TRUE(row.ok) << row.part << ", " << row.caseName << ": " << row.what << " " << row.figure << " > "
                        << row.bound;
}

}  // namespace
}  // namespace vicus::avatars
