/// Based on: Kasten and Young 1989, "Revised optical air mass tables" (how much air light crosses); the sky's colours
/// by the sun's height are tuned by eye against photographs' order of brightness, with an eye that has got used to the
/// dark: dusk is as bright as a cloudy day of film, night as a moonlit one.
#include "scenegraph/light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vicus::scenegraph {
namespace {

/// The sky at one height of the sun.
struct SkyRow {
  float degrees;  ///< the sun's elevation
  glm::vec3 zenith, horizon, glow;
};

/// From night to noon; between two rows it is mixed.
constexpr std::array<SkyRow, 8> kSky = {{
    {-16, {0.016f, 0.026f, 0.058f}, {0.032f, 0.044f, 0.078f}, {0.000f, 0.000f, 0.000f}},
    {-9, {0.022f, 0.038f, 0.090f}, {0.060f, 0.068f, 0.105f}, {0.085f, 0.040f, 0.018f}},
    {-4, {0.042f, 0.078f, 0.180f}, {0.170f, 0.150f, 0.175f}, {0.560f, 0.240f, 0.080f}},
    {0, {0.058f, 0.118f, 0.275f}, {0.330f, 0.300f, 0.310f}, {0.800f, 0.380f, 0.120f}},
    {4, {0.062f, 0.138f, 0.335f}, {0.420f, 0.410f, 0.430f}, {0.560f, 0.350f, 0.160f}},
    {12, {0.061f, 0.147f, 0.375f}, {0.430f, 0.490f, 0.570f}, {0.330f, 0.260f, 0.180f}},
    {30, {0.060f, 0.150f, 0.390f}, {0.420f, 0.530f, 0.660f}, {0.270f, 0.250f, 0.215f}},
    {90, {0.060f, 0.150f, 0.390f}, {0.420f, 0.530f, 0.660f}, {0.285f, 0.270f, 0.240f}},
}};

SkyRow skyAt(float degrees) {
  const auto above =
      std::upper_bound(kSky.begin(), kSky.end(), degrees, [](float d, const SkyRow& row) { return d < row.degrees; });
  if (above == kSky.begin()) return kSky.front();
  if (above == kSky.end()) return kSky.back();
  const SkyRow &a = *std::prev(above), &b = *above;
  const float t = (degrees - a.degrees) / (b.degrees - a.degrees);
  return {degrees, glm::mix(a.zenith, b.zenith, t), glm::mix(a.horizon, b.horizon, t), glm::mix(a.glow, b.glow, t)};
}

/// Part of the sun's light that comes through the air to an eye below, for red, green and blue: the optical depths of a
/// clear day over the air mass.
glm::vec3 throughAir(float degrees) {
  const float h = std::max(degrees, -1.0f);
  const float airMass = 1 / (std::sin(glm::radians(h)) + 0.50572f * std::pow(h + 6.07995f, -1.6364f));
  return glm::exp(-glm::vec3(0.075f, 0.115f, 0.20f) * airMass);
}

}  // namespace

Light lightOf(const city::Environment& environment) {
  const city::Environment usual;
  const auto orUsual = [](double value, double otherwise) { return std::isfinite(value) ? value : otherwise; };
  const double azimuth = orUsual(environment.sunAzimuth, usual.sunAzimuth);
  const double elevation = orUsual(environment.sunElevation, usual.sunElevation);
  const double haze = orUsual(environment.hazeDistance, usual.hazeDistance);

  Light light;
  light.sunDirection =
      glm::vec3(std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
  const float height = std::clamp(light.sunDirection.z, -1.0f, 1.0f);
  const float degrees = glm::degrees(std::asin(height));
  // The disc goes down within its own width and the refraction's.
  light.sun = 1.42f * throughAir(degrees) * glm::smoothstep(-0.8f, 0.4f, degrees);
  const SkyRow sky = skyAt(degrees);
  light.zenith = sky.zenith;
  light.horizon = sky.horizon;
  light.glow = sky.glow;
  // About the sky's cosine-weighted mean.
  light.sky = 0.43f * sky.horizon + 0.35f * sky.zenith + 0.13f * sky.glow + glm::vec3(0.02f);
  light.bounce = 0.19f * glm::vec3(0.95f, 0.9f, 0.75f) * (std::max(height, 0.0f) * light.sun + light.sky);
  light.hazeDensity = static_cast<float>(1.0 / std::max(haze, 1.0));
  return light;
}

}  // namespace vicus::scenegraph
