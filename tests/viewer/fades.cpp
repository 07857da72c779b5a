// Houses between two levels: drawn twice, each pixel once.
#include <gtest/gtest.h>

#include <numbers>

#include "plan/planner.hpp"
#include "small_cities.hpp"
#include "viewer/pictures.hpp"
#include "viewer/renderer.hpp"

namespace vicus::viewer {
namespace {

/// A house whose front has a board of brick before it; flat, it is bare.
city::BuildingGeometry houseWithBoard() {
  city::BuildingBuilder builder("house");
  builder.beginLevel(0, 6);
  builder.beginPlane(city::PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({-4, 0, 0}, {4, 0, 0}, {4, 0, 6}, {-4, 0, 6}, 0);
  builder.beginExternalGeometry(0.5f);
  builder.addQuad({-3, -0.5f, 1}, {3, -0.5f, 1}, {3, -0.5f, 5}, {-3, -0.5f, 5}, 1);
  builder.setFootprint({{glm::vec2(-4, 0), glm::vec2(4, 0), glm::vec2(4, 5), glm::vec2(-4, 5)}});
  return builder.finish();
}

bool samePixel(const Picture& a, const Picture& b, size_t pixel) {
  return std::equal(&a.rgb[3 * pixel], &a.rgb[3 * pixel] + 3, &b.rgb[3 * pixel]);
}

TEST(Fades, EveryPixelShowsOneOfTheTwoLevels) {
  std::string error;
  const auto context = makeOffscreenContext(error);
  if (!context) GTEST_SKIP() << "no offscreen GL: " << error;
  city::City city = test::cityOf({{0, 0}, {12, 0}});
  city.buildingTypes = {houseWithBoard()};
  city.materials.push_back(test::plaster());
  city.materials.back().source = "builtin:brick";
  city::finishCity(city, {city.buildings.instances, {}});

  for (const double ordering : {1.0, 0.0}) {
    city::Knobs knobs;
    for (const auto list : {plan::planKnobs(), scenegraph::sceneKnobs()}) knobs.declare(list);
    knobs.set("house_lod.picture_mb", 0);
    knobs.set("state_ordering", ordering);
    city::Diagnostics diagnostics;
    scenegraph::Scene scene(city, knobs, diagnostics);
    Renderer renderer(*context, scene, 1);

    city::FramePlan plan;
    plan.view = city::makeView({{6, -12, 3}, std::numbers::pi / 2, 0, 0}, 1, {320, 180});
    plan.buildings.drawn = {{0, 2}};
    plan.buildings.drawnCount = plan.buildings.inFrustumCount = 2;
    const auto picture = [&](uint8_t level, std::vector<city::HouseFade> fades) {
      plan.houseLod.levels.assign(2, level);
      plan.houseLod.fades = std::move(fades);
      renderer.draw(plan);
      return renderer.readPicture();
    };
    const Picture full = picture(0, {}), flat = picture(2, {});
    ASSERT_GT(compare(full, flat).differingPixels, 2000u);
    for (const float share : {0.0f, 0.3f, 0.9f}) {
      const Picture faded = picture(2, {{0, share}, {1, share}});
      uint64_t shownFlat = 0, differing = 0;
      for (size_t i = 0; i < full.rgb.size() / 3; ++i) {
        const bool likeFull = samePixel(faded, full, i), likeFlat = samePixel(faded, flat, i);
        ASSERT_TRUE(likeFull || likeFlat) << "pixel " << i << " shows neither";
        differing += !samePixel(full, flat, i);
        shownFlat += !likeFull;
      }
      EXPECT_NEAR(static_cast<double>(shownFlat) / static_cast<double>(differing), share, 0.02);
      const ItemBuffer items = renderer.drawItems(plan);
      picture(0, {});
      EXPECT_EQ(items.ids, renderer.drawItems(plan).ids) << "no hole in either house";
    }
    EXPECT_EQ(compare(full, picture(2, {{0, 0}, {1, 0}})).differingPixels, 0u);
    EXPECT_EQ(renderer.problems(), std::vector<std::string>());
  }
}

}  // namespace
}  // namespace vicus::viewer
