#include "assets/styles/file_watch.hpp"

#include <gmock/gmock.h>

#include "import_files.hpp"

namespace vicus::assets {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FileWatch, TellsAChangeOnce) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.rules", "one"), b = folder.write("b.rules", "one");
  FileWatch watch({a, b});
  EXPECT_THAT(watch.changed(), IsEmpty());
  folder.write("b.rules", "another");
  EXPECT_THAT(watch.changed(), ElementsAre(b));
  EXPECT_THAT(watch.changed(), IsEmpty());
}

TEST(FileWatch, ANewDateAloneIsNoChange) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.rules", "one");
  FileWatch watch({a});
  std::filesystem::last_write_time(a, std::filesystem::last_write_time(a) + std::chrono::hours(1));
  EXPECT_THAT(watch.changed(), IsEmpty());
}

TEST(FileWatch, AFileThatIsGoneForAMomentIsUnchanged) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.rules", "one");
  FileWatch watch({a});
  std::filesystem::remove(a);
  EXPECT_THAT(watch.changed(), IsEmpty());
  folder.write("a.rules", "one");
  EXPECT_THAT(watch.changed(), IsEmpty());
  std::filesystem::remove(a);
  EXPECT_THAT(watch.changed(), IsEmpty());
  folder.write("a.rules", "something else");
  EXPECT_THAT(watch.changed(), ElementsAre(a));
}

}  // namespace
}  // namespace vicus::assets
