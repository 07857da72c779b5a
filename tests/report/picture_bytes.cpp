#include "report/picture_bytes.hpp"

#include "pictures.hpp"

namespace vicus::report {
namespace {

TEST(Reduced, AveragesInLinearLight) {
  const auto checks = testing::picture(8, 8, [](int x, int y) -> testing::Pixel {
    const auto v = static_cast<uint8_t>((x + y) % 2 == 0 ? 0 : 255);
    return {v, v, v};
  });
  const auto small = reduced(checks, 4);
  ASSERT_EQ(small.width, 4);
  ASSERT_EQ(small.height, 4);
  for (const uint8_t v : small.rgb) EXPECT_EQ(v, 188);  // half the light of white
}

TEST(Reduced, NeverEnlargesAndKeepsStrangeShapes) {
  EXPECT_EQ(reduced(testing::town(10, 10), 20).width, 10);
  const auto line = reduced(testing::town(1000, 1), 100);
  EXPECT_EQ(line.width, 100);
  EXPECT_EQ(line.height, 1);
}

TEST(Base64, Rfc4648Examples) {
  const auto encode = [](std::string_view text) { return base64({text.begin(), text.end()}); };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace vicus::report
