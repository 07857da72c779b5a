#include "assets/norvic/landscape.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include "city/random.hpp"

namespace vicus::assets::norvic {
namespace {

// Lengths of the river's meanders and how far each swings: together they turn by 40° at most.
constexpr double kWaves[3] = {1950, 810, 430};
constexpr double kSwings[3] = {95, 48, 16};
constexpr double kTau = 6.283185307179586;
constexpr double kRiverY = 150;     // where the river crosses x = 0
constexpr double kPlainWidth = 42;  // of the flood plain beyond the river's dry distance

double smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

Landscape::Landscape(double side, double spacing, uint32_t seed, bool river)
    : side_(side),
      spacing_(spacing),
      seed_(seed),
      hasRiver_(river),
      riverHalfWidth_(std::max(14.0, 1.6 * spacing)),
      bankWidth_(std::max(7.0, 1.5 * spacing)) {
  city::Random random(city::hash32(seed, 0x71e4U));
  for (double& phase : phase_) phase = random.uniform(0, kTau);
  offset_ = kRiverY;
  offset_ -= riverAt(0) - kRiverY;
}

double Landscape::riverAt(double x) const {
  double y = offset_;
  for (int k = 0; k < 3; ++k) y += kSwings[k] * std::sin(x * kTau / kWaves[k] + phase_[k]);
  return y;
}

double Landscape::riverSlope(double x) const {
  double slope = 0;
  for (int k = 0; k < 3; ++k) slope += kSwings[k] * kTau / kWaves[k] * std::cos(x * kTau / kWaves[k] + phase_[k]);
  return slope;
}

glm::dvec2 Landscape::riverDirection(double x) const {
  return glm::normalize(glm::dvec2(1, riverSlope(x)));
}

double Landscape::riverDistance(glm::dvec2 p) const {
  if (!hasRiver_) return 1e9;
  // One Newton-like step along x from the point's own abscissa to that of the nearest point.
  const double away = p.y - riverAt(p.x);
  const double far = 0.85 * std::abs(away);  // good enough where only the valley's broad slopes ask
  if (std::abs(away) > 400) return far;
  const double slope = riverSlope(p.x);
  const double x = p.x + away * slope / (1 + slope * slope);
  const double away1 = p.y - riverAt(x), slope1 = riverSlope(x);
  const double x1 = x + (away1 * slope1 - (x - p.x)) / (1 + slope1 * slope1);
  const double near = glm::length(p - glm::dvec2(x1, riverAt(x1)));
  return glm::mix(near, far, smooth(250, 400, std::abs(away)));
}

double Landscape::natural(glm::dvec2 p) const {
  const double hills = 9.0 * noise(p, 830, seed_) + 2.2 * noise(p, 310, seed_ + 1);
  if (!hasRiver_) return kPlainHeight + 6 + hills;
  const double d = riverDistance(p);
  const double plainEnd = dryDistance() + kPlainWidth;
  const double valley = 3.0 * smooth(plainEnd, 200, d) + 9.0 * smooth(60, 700, d);
  double h = kPlainHeight + valley + (hills + 5) * smooth(plainEnd, 420, d);
  h = std::max(h, kPlainHeight);
  // The banks, and the bed two metres under the water.
  const double bed = kWaterLevel - 2.0;
  return bed + (h - bed) * smooth(riverHalfWidth_, riverHalfWidth_ + bankWidth_, d);
}

void Landscape::addLevelGround(glm::dvec2 centre, double radius, double blend) {
  level_.push_back({centre, radius, blend, height(centre)});
}

void Landscape::setMound(glm::dvec2 centre, double topRadius, double footRadius, double rise) {
  moundCentre_ = centre, moundTop_ = topRadius, moundFoot_ = footRadius, moundRise_ = rise;
}

double Landscape::height(glm::dvec2 p) const {
  double h = natural(p);
  for (const LevelGround& g : level_) {
    const double d = glm::length(p - g.centre);
    if (d >= g.radius + g.blend) continue;
    // Not over the river and its banks.
    const double share = smooth(dryDistance() + 3, dryDistance() + 40, riverDistance(p));
    h += (g.height - h) * share * (1 - smooth(g.radius, g.radius + g.blend, d));
  }
  if (moundRise_ > 0) {
    const double d = glm::length(p - moundCentre_);
    h += moundRise_ * (1 - smooth(moundTop_, moundFoot_, d));
    h -= 2.5 * smooth(moundFoot_ - 4, moundFoot_ + 4, d) * (1 - smooth(moundFoot_ + 6, moundFoot_ + 14, d));
  }
  return h;
}

city::HeightField Landscape::heightField() const {
  city::HeightField field;
  const int samples = static_cast<int>(std::lround(side_ / spacing_)) + 1;
  field.origin = glm::dvec2(-0.5 * side_);
  field.spacing = glm::dvec2(side_ / (samples - 1));
  field.size = glm::ivec2(samples);
  field.heights.resize(static_cast<size_t>(samples) * static_cast<size_t>(samples));
  // Rows are dealt out to the threads; each sample depends on its place alone.
  const int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  {
    std::vector<std::jthread> workers;
    for (int t = 0; t < threads; ++t)
      workers.emplace_back([&, t] {
        for (int row = t; row < samples; row += threads)
          for (int column = 0; column < samples; ++column)
            field.at(column, row) = static_cast<float>(height(field.origin + field.spacing * glm::dvec2(column, row)));
      });
  }
  field.updateRange();
  return field;
}

city::WaterBody Landscape::water() const {
  city::WaterBody body;
  body.name = "river";
  body.level = kWaterLevel;
  const double half = riverHalfWidth_ + bankWidth_;
  const int pieces = static_cast<int>(std::ceil(side_ / 16));
  for (int i = 0; i <= pieces; ++i) {
    const double x = side_ * (static_cast<double>(i) / pieces - 0.5);
    const glm::dvec2 along = riverDirection(x);
    const glm::dvec2 left(-along.y, along.x);
    const glm::dvec2 middle(x, riverAt(x));
    // At the field's edges the strip ends square with them.
    const glm::dvec2 out = i == 0 || i == pieces ? glm::dvec2(0, 1 / along.x) : left;
    body.points.push_back(middle + out * half);
    body.points.push_back(middle - out * half);
    if (i == 0) continue;
    const auto k = static_cast<uint32_t>(2 * i);
    body.indices.insert(body.indices.end(), {k - 2, k - 1, k + 1, k - 2, k + 1, k});
  }
  return body;
}

}  // namespace vicus::assets::norvic
