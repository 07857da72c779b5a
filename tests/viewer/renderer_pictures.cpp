// What the renderer draws, through a real GL context without a display.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "../scenegraph/small_city.hpp"
#include "viewer/renderer.hpp"

namespace vicus::viewer {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using tests::everything;
using tests::smallCity;

city::Knobs knobs(bool ordering = true) {
  city::Knobs k;
  k.declare(scenegraph::sceneKnobs());
  k.set("textures.budget_mb", 2);
  k.set("ground.map_size", 256);
  k.set("state_ordering", ordering);
  return k;
}

/// A city with its scene and renderer.
struct Drawn {
  city::City city;
  city::Diagnostics diagnostics;
  scenegraph::Scene scene;
  Renderer renderer;

  Drawn(GlContext& context, city::City from, const city::Knobs& k, int multisamples = 1)
      : city(std::move(from)), scene(city, k, diagnostics), renderer(context, scene, multisamples) {}

  Picture picture(const city::ViewState& view) {
    renderer.draw(everything(city, view));
    return renderer.readPicture();
  }
};

/// Pixels that differ by more than `most` of 255 in some channel.
size_t differing(const Picture& a, const Picture& b, int most) {
  if (a.rgb.size() != b.rgb.size()) return SIZE_MAX;
  size_t count = 0;
  for (size_t i = 0; i < a.rgb.size(); i += 3) {
    int worst = 0;
    for (size_t k = i; k < i + 3; ++k) worst = std::max(worst, std::abs(int{a.rgb[k]} - int{b.rgb[k]}));
    count += worst > most;
  }
  return count;
}

class RendererTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    context_ = makeOffscreenContext(error);
    if (!context_) GTEST_SKIP() << "no offscreen GL: " << error;
  }

  static city::ViewState view(const glm::dvec3& eye, double heading, double pitch, glm::ivec2 size = {320, 180}) {
    return city::makeView({eye, heading, pitch, 0}, 1.0472, size);
  }
  static city::ViewState street(const glm::dvec3& shift = glm::dvec3(0)) {
    return view(shift + glm::dvec3(0, -75, 6), 1.5, -0.05);
  }
  static city::ViewState air(const glm::dvec3& shift = glm::dvec3(0)) {
    return view(shift + glm::dvec3(-90, -120, 80), 0.9, -0.5);
  }

  std::unique_ptr<GlContext> context_;
};

TEST_F(RendererTest, NamesItsCard) {
  EXPECT_THAT(context_->rendererName(), testing::Not(IsEmpty()));
}

TEST_F(RendererTest, ItemsAreWhatStandsThere) {
  Drawn d(*context_, smallCity(), knobs());
  // Straight down on each house in turn, a little off its ridge.
  for (uint32_t i = 0; i < d.city.buildings.size(); i += 7) {
    const glm::dvec3 at = d.city.buildings.instances[i].position;
    const ItemBuffer items =
        d.renderer.drawItems(everything(d.city, view(at + glm::dvec3(0.4, 0.5, 30), 0, -M_PI / 2, {33, 33})));
    EXPECT_EQ(items.ids[16 * 33 + 16], d.city.itemOfBuilding(i));
  }
  const glm::dvec3 tower = d.city.monuments[0].position;
  const ItemBuffer items = d.renderer.drawItems(everything(d.city, view(tower + glm::dvec3(1, 1, 60), 0, -M_PI / 2)));
  EXPECT_EQ(items.ids[90 * 320 + 160], d.city.itemOfMonument(0));

  const ItemBuffer level = d.renderer.drawItems(everything(d.city, street()));
  EXPECT_EQ(level.ids.front(), 0u) << "the sky has no item";
  EXPECT_EQ(level.ids.back(), city::kItemOther) << "the ground hides and is not counted";
  EXPECT_THAT(d.renderer.problems(), IsEmpty());
}

TEST_F(RendererTest, OrderingChangesNoPixel) {
  Drawn ordered(*context_, smallCity(), knobs(true));
  const Picture street1 = ordered.picture(street()), air1 = ordered.picture(air());
  const ItemBuffer items = ordered.renderer.drawItems(everything(ordered.city, air()));
  Drawn unordered(*context_, smallCity(), knobs(false));
  EXPECT_EQ(differing(street1, unordered.picture(street()), 0), 0u);
  EXPECT_EQ(differing(air1, unordered.picture(air()), 0), 0u);
  EXPECT_EQ(items.ids, unordered.renderer.drawItems(everything(unordered.city, air())).ids);
  EXPECT_GT(unordered.scene.counts().drawCalls, 5 * ordered.scene.counts().drawCalls);
  EXPECT_THAT(ordered.renderer.problems(), IsEmpty());
  EXPECT_THAT(unordered.renderer.problems(), IsEmpty());
}

TEST_F(RendererTest, ACityFarFromTheOriginLooksTheSame) {
  const Picture street0 = Drawn(*context_, smallCity(), knobs()).picture(street());
  const Picture air0 = Drawn(*context_, smallCity(), knobs()).picture(air());
  tests::SmallCityOptions far;
  far.shift = {1e7, -4e6, 0};
  Drawn d(*context_, smallCity(far), knobs());
  const auto most = static_cast<size_t>(1e-4 * 320 * 180);
  EXPECT_LE(differing(street0, d.picture(street(far.shift)), 1), most);
  EXPECT_LE(differing(air0, d.picture(air(far.shift)), 1), most);
}

TEST_F(RendererTest, AReferenceAgreesWithThePictureWhateverItsPieces) {
  Drawn d(*context_, smallCity(), knobs(), 4);
  // Wider than one piece of 1 024 pixels.
  city::ViewState wide = view({0, -75, 6}, 1.5, -0.05, {1040, 40});
  const Picture picture = d.picture(wide);
  const Picture reference = d.renderer.drawReference(everything(d.city, wide));
  ASSERT_EQ(reference.rgb.size(), picture.rgb.size());
  double squares = 0;
  for (size_t i = 0; i < picture.rgb.size(); ++i) {
    const double e = int{picture.rgb[i]} - int{reference.rgb[i]};
    squares += e * e;
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(picture.rgb.size())), 9) << "of 255";
  // The seam between the pieces is no worse than the columns about it.
  const auto column = [&](int x) {
    double sum = 0;
    for (int y = 0; y < 40; ++y)
      for (int k = 0; k < 3; ++k) {
        const size_t at = 3 * static_cast<size_t>(y * 1040 + x) + static_cast<size_t>(k);
        sum += std::abs(int{picture.rgb[at]} - int{reference.rgb[at]});
      }
    return sum / 120;
  };
  EXPECT_LT(std::max(column(1023), column(1024)), 10);
  EXPECT_THAT(d.renderer.problems(), IsEmpty());
}

TEST_F(RendererTest, MultisamplingSmoothsEdgesOnly) {
  const Picture plain = Drawn(*context_, smallCity(), knobs(), 1).picture(air());
  const Picture smooth = Drawn(*context_, smallCity(), knobs(), 4).picture(air());
  const size_t different = differing(plain, smooth, 24);
  EXPECT_GT(different, 50u);
  EXPECT_LT(different, size_t{320 * 180 / 4});
}

TEST_F(RendererTest, TheSkyIsAsBrightAsTheHazeMeetsIt) {
  tests::SmallCityOptions options;
  options.terrain = options.trees = options.monument = options.water = false;
  Drawn d(*context_, smallCity(options), knobs());
  // Level, away from the houses: ground below the middle row, sky above; far ground is the sky's colour.
  city::ViewState out = view({0, 0, 40}, 1, 0, {64, 512});
  out.verticalFov = 0.05;
  const Picture picture = d.picture(out);
  const auto pixel = [&](int y) { return &picture.rgb[3 * static_cast<size_t>(y * 64 + 32)]; };
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(pixel(254)[k], pixel(258)[k], 2) << "channel " << k;
}

TEST_F(RendererTest, ExtremeViewsDrawWithoutProblems) {
  Drawn d(*context_, smallCity(), knobs(), 4);
  const glm::dvec3 house = d.city.buildings.instances[3].position;
  for (const glm::dvec3 eye : {house, house + glm::dvec3(0, 0, 5e4), glm::dvec3(0, 0, -500), glm::dvec3(1e6, 1e6, 10)})
    for (const double pitch : {-M_PI / 2, 0.0, M_PI / 2})
      for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(4096, 1), glm::ivec2(7, 33)})
        EXPECT_EQ(d.picture(view(eye, 0.3, pitch, size)).width, size.x);
  for (const double fov : {1e-3, 3.12}) {
    city::ViewState v = street();
    v.verticalFov = fov;
    EXPECT_EQ(d.picture(v).width, 320);
  }
  EXPECT_THAT(d.renderer.problems(), IsEmpty());
}

TEST_F(RendererTest, AWallAtArmsLengthFillsThePicture) {
  Drawn d(*context_, smallCity(), knobs());
  const city::Instance& house = d.city.buildings.instances[0];
  const city::BuildingGeometry& type = d.city.buildingTypes[house.geometry];
  // 0.06 m in front of the north wall, looking at it.
  const double back = static_cast<double>(type.bounds.max.y) - 0.3, c = std::cos(static_cast<double>(house.heading)),
               s = std::sin(static_cast<double>(house.heading));
  const double y = back + 0.06;
  const glm::dvec3 eye = house.position + glm::dvec3(-s * y, c * y, 1.2);
  const city::ViewState v = view(eye, static_cast<double>(house.heading) - M_PI / 2, 0);
  const ItemBuffer items = d.renderer.drawItems(everything(d.city, v));
  EXPECT_EQ(std::count(items.ids.begin(), items.ids.end(), d.city.itemOfBuilding(0)), 320 * 180);
}

TEST_F(RendererTest, APictureLargerThanTheCardCanIsReported) {
  Drawn d(*context_, smallCity(), knobs());
  city::ViewState huge = street();
  huge.viewport = {1 << 20, 1};
  d.renderer.draw(everything(d.city, huge));
  ASSERT_EQ(d.renderer.problems().size(), 1u);
  EXPECT_THAT(d.renderer.problems()[0], HasSubstr("larger than the card's"));
}

TEST_F(RendererTest, WhatThePlanLeavesOutIsNotDrawn) {
  Drawn d(*context_, smallCity(), knobs());
  city::FramePlan plan = everything(d.city, air());
  plan.buildings.drawn = {{4, 3}};
  plan.monuments.clear();
  const ItemBuffer items = d.renderer.drawItems(plan);
  for (const uint32_t id : items.ids)
    if (id != 0 && id != city::kItemOther) {
      EXPECT_GE(id, d.city.itemOfBuilding(4));
      EXPECT_LE(id, d.city.itemOfBuilding(6));
    }
}

}  // namespace
}  // namespace vicus::viewer
