#include <gmock/gmock.h>

#include <cmath>

#include "houselod/bake.hpp"
#include "houselod/levels.hpp"
#include "houselod/texture_plan.hpp"

namespace vicus::houselod {
namespace {

using glm::ivec2;
using glm::vec2;
using glm::vec3;

constexpr city::MaterialId kWall = 0, kFrame = 1, kPane = 2;

/// A wall `width` m wide and 4 m high that faces south from y = `south`: a pane at its left half's middle, 0.3 m deep,
/// a frame before its right half.
city::BuildingGeometry wall(float width = 8, float south = 0) {
  city::BuildingBuilder builder("wall");
  const auto quad = [&](float l, float b, float r, float t, float out, city::MaterialId material) {
    builder.addQuad({l, south - out, b}, {r, south - out, b}, {r, south - out, t}, {l, south - out, t}, material);
  };
  builder.beginPlane(city::PlaneKind::Wall, kWall, {0, -1, 0});
  quad(0, 0, 1, 4, 0, kWall), quad(3, 0, width, 4, 0, kWall), quad(1, 0, 3, 1, 0, kWall), quad(1, 3, 3, 4, 0, kWall);
  builder.beginFlat();
  quad(0, 0, width, 4, 0, kWall);
  builder.beginExternalOpening(0.3f);
  quad(1, 1, 3, 3, -0.3f, kPane);
  builder.beginExternalGeometry(0.1f);
  quad(5, 1, 7, 3, 0.1f, kFrame);
  return builder.finish();
}

/// Materials of one colour each.
struct Colours {
  Colours() {
    for (const auto& [r, g, b] : {std::tuple{200, 180, 100}, {90, 60, 30}, {20, 40, 60}})
      texels.push_back({static_cast<uint8_t>(r), static_cast<uint8_t>(g), static_cast<uint8_t>(b), 255});
    for (size_t i = 0; i < texels.size(); ++i) {
      BakedFrom& m = materials.emplace_back();
      m.size = 1, m.levels = {std::span<const uint8_t>(texels[i])};
      m.specular = i == kPane ? 0.8f : 0;
    }
  }
  std::vector<std::vector<uint8_t>> texels;
  std::vector<BakedFrom> materials;
};

std::array<int, 4> texelAt(const TexturePlan& plan, const std::vector<uint8_t>& page, vec2 uv) {
  const ivec2 at(glm::floor(uv * static_cast<float>(plan.pageSize)));
  const size_t i = 4 * (static_cast<size_t>(at.y) * static_cast<size_t>(plan.pageSize) + static_cast<size_t>(at.x));
  return {page[i], page[i + 1], page[i + 2], page[i + 3]};
}

TEST(TexturePlan, FillsItsPagesAndKeepsPicturesApart) {
  std::vector<city::BuildingGeometry> types;
  for (int i = 0; i < 40; ++i) types.push_back(wall(static_cast<float>(8 + i % 9)));
  const TexturePlan plan = planPictures(types, 3, 256);
  ASSERT_EQ(plan.pictures.size(), 40u);
  EXPECT_LE(plan.pages, 3u);
  size_t filled = 0;
  for (size_t i = 0; i < plan.pictures.size(); ++i) {
    const PlanePicture& a = plan.pictures[i];
    EXPECT_EQ(a.corner % kPictureGrid, ivec2(0));
    EXPECT_TRUE(glm::all(glm::lessThanEqual(a.corner + a.size, ivec2(256))));
    filled += static_cast<size_t>(a.size.x) * static_cast<size_t>(a.size.y);
    for (size_t k = 0; k < i; ++k) {
      const PlanePicture& b = plan.pictures[k];
      const bool apart = a.page != b.page || a.corner.x >= b.corner.x + b.size.x ||
                         b.corner.x >= a.corner.x + a.size.x || a.corner.y >= b.corner.y + b.size.y ||
                         b.corner.y >= a.corner.y + a.size.y;
      EXPECT_TRUE(apart) << i << " and " << k;
    }
  }
  EXPECT_GT(filled, 0.5 * 3 * 256 * 256);
  for (const float detail : plan.detail) EXPECT_NEAR(detail, 1 / plan.texelsPerMetre, 0.05);
}

TEST(TexturePlan, HasNothingWithoutRoomOrWithoutThingsOnWalls) {
  const std::vector<city::BuildingGeometry> types{wall()};
  EXPECT_TRUE(planPictures(types, 0, 256).pictures.empty());
  EXPECT_TRUE(planPictures({}, 3, 256).pictures.empty());
  EXPECT_TRUE(picturesWithin(types, 0).pictures.empty());
  EXPECT_EQ(picturesWithin(types, 32).pages, 1u);
  EXPECT_DOUBLE_EQ(picturesWithin(types, 32).texelsPerMetre, kFinestPicture);
  const std::vector<city::BuildingGeometry> many(4000, wall());
  EXPECT_TRUE(picturesWithin(many, 3).pictures.empty()) << "coarser than is worth having";
  EXPECT_EQ(picturesWithin(many, 3).detail[0], 0);
}

TEST(Bake, ShowsTheWallWithAllThatIsOnIt) {
  const std::vector<city::BuildingGeometry> types{wall(8, 3)};
  const TexturePlan plan = planPictures(types, 1, 128);
  ASSERT_EQ(plan.pictures.size(), 1u);
  const Colours colours;
  std::vector<uint8_t> page(4 * 128 * 128, 0);
  bakePicture(types[0], plan, plan.pictures[0], colours.materials, page);
  const PlaneFrame frame = planeFrame(types[0], types[0].planes[0]);
  const auto seen = [&](float x, float z) {
    return texelAt(plan, page, onPage(plan, plan.pictures[0], frame, {x, 3, z}));
  };
  using testing::ElementsAre;
  EXPECT_THAT(seen(0.1f, 0.1f), ElementsAre(200, 180, 100, 0));
  EXPECT_THAT(seen(7.9f, 3.9f), ElementsAre(200, 180, 100, 0));
  EXPECT_THAT(seen(4, 2), ElementsAre(200, 180, 100, 0));
  EXPECT_THAT(seen(2, 2), ElementsAre(20, 40, 60, 204)) << "the pane with its gloss, behind the wall's surface";
  EXPECT_THAT(seen(6, 2), ElementsAre(90, 60, 30, 0)) << "the frame before the wall hides it";
}

/// The picture's light is that of the surfaces: by area.
TEST(Bake, KeepsTheMeanLight) {
  const std::vector<city::BuildingGeometry> types{wall()};
  const TexturePlan plan = planPictures(types, 1, 256);
  const Colours colours;
  std::vector<uint8_t> page(4 * 256 * 256, 0);
  const PlanePicture& picture = plan.pictures[0];
  bakePicture(types[0], plan, picture, colours.materials, page);
  double sum = 0;
  for (int y = 0; y < picture.size.y; ++y)
    for (int x = 0; x < picture.size.x; ++x) {
      const double root =
          page[4 * (static_cast<size_t>(picture.corner.y + y) * 256 + static_cast<size_t>(picture.corner.x + x))] /
          255.0;
      sum += root * root;
    }
  const auto light = [](double root) { return root / 255 * (root / 255); };
  const double expected = (24 * light(200) + 4 * light(90) + 4 * light(20)) / 32;
  EXPECT_NEAR(sum / (picture.size.x * picture.size.y), expected, 0.02 * expected);
}

TEST(Bake, LevelsAverageLightAndFitTheirArray) {
  std::vector<uint8_t> page;
  for (int i = 0; i < 4 * 4; ++i) {
    const auto v = static_cast<uint8_t>(i % 2 == 0 ? 0 : 200);
    page.insert(page.end(), {v, v, v, v});
  }
  const auto levels = pageLevels(page, 4, 4);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[1].size(), 16u);
  EXPECT_NEAR(levels[1][0], 200 * std::sqrt(0.5), 1);
  EXPECT_EQ(levels[1][3], 100);
  const auto larger = pageLevels(page, 4, 8);
  ASSERT_EQ(larger.size(), 4u);
  EXPECT_EQ(larger[1], levels[0]);
  EXPECT_EQ(pageLevels(page, 4, 2)[0], levels[1]);
}

}  // namespace
}  // namespace vicus::houselod
