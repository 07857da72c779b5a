#include "scenegraph/roam_drawable.hpp"

#include <gmock/gmock.h>

namespace vicus::scenegraph {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(JoinSlots, JoinsWhatIsNearAndKeepsApartWhatIsFar) {
  EXPECT_THAT(joinSlots({}), IsEmpty());
  EXPECT_THAT(joinSlots({7}), ElementsAre(SlotRun{7, 1}));
  EXPECT_THAT(joinSlots({9, 3, 4, 9}), ElementsAre(SlotRun{3, 7}));
  EXPECT_THAT(joinSlots({1000, 3, 5}), ElementsAre(SlotRun{3, 3}, SlotRun{1000, 1}));
}

}  // namespace
}  // namespace vicus::scenegraph
