#include "terrain/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "city/random.hpp"
#include "terrain/error_table.hpp"
#include "terrain/mesh_check.hpp"
#include "terrain/roam.hpp"

namespace vicus::terrain {
namespace {

using city::HeightField;
using city::StabilityRow;
using city::ViewState;

constexpr double kFov = std::numbers::pi / 3;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
/// What rounding may add to a measured error: pixels are worked out in float.
constexpr double kRounding = 1e-4;

HeightField makeField(glm::ivec2 size, float height = 0) {
  HeightField field;
  field.size = size;
  field.spacing = glm::dvec2(10);
  field.heights.assign(static_cast<size_t>(std::max(size.x, 0)) * static_cast<size_t>(std::max(size.y, 0)), height);
  return field;
}

/// Hills of three wavelengths with a rough surface.
HeightField hills(glm::ivec2 size, uint32_t seed = 1) {
  HeightField field = makeField(size);
  city::Random random(seed);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      field.at(x, y) = static_cast<float>(60 * std::sin(x * 0.05) * std::cos(y * 0.04) +
                                          15 * std::sin(x * 0.23 + y * 0.31) + random.uniform(-1, 1));
  field.updateRange();
  return field;
}

/// A view from `fraction` of the field's extent, `above` metres over its surface.
ViewState viewOver(const HeightField& field, glm::dvec2 fraction, double above, double heading, double pitch = -0.1) {
  const glm::dvec2 place = field.origin + fraction * field.extent();
  return city::makeView({glm::dvec3(place, field.heightAt(place.x, place.y).value_or(0) + above), heading, pitch, 0},
                        kFov, {1280, 720});
}

/// What one mesh, kept from view to view, showed.
struct Outcome {
  double faults = 0;         ///< cracks, flipped triangles, wrong vertices, ground without a triangle, broken links
  double errorOfStated = 0;  ///< largest of measured pixel error / stated one
  double statedOfWanted = 0;
  double triangles = 0;  ///< of the last mesh
};

Outcome follow(const HeightField& field, const std::vector<ViewState>& views, const RoamSettings& settings) {
  const ErrorTable table = buildErrorTable(field);
  Roam roam(field, table);
  MeshBuffers mesh;
  Outcome outcome;
  const int64_t cells = field.empty() ? 0 : int64_t{field.size.x - 1} * (field.size.y - 1);
  for (const ViewState& view : views) {
    const RoamFrame frame = roam.update(view, settings);
    mesh.apply(frame);
    const MeshFaults faults = findFaults(field, mesh.held);
    const MeasuredError error = measureError(field, mesh.held, &view);
    const bool whole = table.filled.empty();
    outcome.faults += whole ? std::abs(faults.coveredArea - static_cast<double>(cells)) : 0;
    outcome.faults += static_cast<double>(faults.cracks + faults.flipped + error.uncovered) +
                      (settings.morph < 1 ? 0 : static_cast<double>(faults.twisted)) + (roam.broken().empty() ? 0 : 1);
    outcome.errorOfStated = std::max(outcome.errorOfStated, error.largestPixels / frame.pixelError);
    outcome.statedOfWanted = std::max(outcome.statedOfWanted, frame.pixelError / settings.pixelError);
    outcome.triangles = frame.triangleCount;
  }
  return outcome;
}

std::vector<ViewState> lookAround(const HeightField& field) {
  std::vector<ViewState> views;
  for (int i = 0; i < 4; ++i) views.push_back(viewOver(field, {0.2 + 0.2 * i, 0.7 - 0.15 * i}, 2 + 30 * i, 1.7 * i));
  return views;
}

/// Eyes anywhere in and over the field, looking anywhere.
std::vector<ViewState> jumps(const HeightField& field, int count, uint32_t seed) {
  city::Random random(seed);
  std::vector<ViewState> views;
  for (int i = 0; i < count; ++i)
    views.push_back(viewOver(field, {random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2)}, random.uniform(-20, 300),
                             random.uniform(0, 6.28), random.uniform(-1.5, 1.5)));
  return views;
}

class Table {
 public:
  /// Two rows: no faults, and no more error than stated.
  void holds(const std::string& name, const Outcome& outcome) {
    row(name, "cracks, flipped triangles, uncovered ground", outcome.faults, 0);
    row(name, "measured pixel error / stated one", outcome.errorOfStated, 1 + kRounding);
  }
  /// The same, and the stated error is the wanted one.
  void reaches(const std::string& name, const Outcome& outcome) {
    holds(name, outcome);
    row(name, "stated pixel error / wanted one", outcome.statedOfWanted, 1);
  }
  void row(std::string name, std::string what, double figure, double bound) {
    rows.push_back(city::stabilityRow("ROAM", std::move(name), std::move(what), figure, bound));
  }
  std::vector<StabilityRow> rows;
};

RoamSettings unlimited(double pixelError = 2) {
  RoamSettings settings;
  settings.pixelError = pixelError;
  settings.budget = std::numeric_limits<uint32_t>::max();
  return settings;
}
RoamSettings withBudget(uint32_t budget) {
  RoamSettings settings;
  settings.budget = budget;
  return settings;
}

void shapes(Table& table) {
  HeightField cliff = makeField({65, 65});
  for (int y = 0; y < 65; ++y)
    for (int x = 33; x < 65; ++x) cliff.at(x, y) = 8848;
  table.reaches("a cliff of 8 848 m between two samples", follow(cliff, lookAround(cliff), unlimited()));

  HeightField spikes = hills({65, 65});
  for (int i = 0; i < 20; ++i) spikes.at((i * 29) % 65, (i * 47) % 65) = i % 2 == 0 ? 5000.0F : -5000.0F;
  table.reaches("spikes of ±5 000 m", follow(spikes, lookAround(spikes), unlimited()));

  for (const glm::ivec2 size : {glm::ivec2(257, 257), glm::ivec2(401, 401), glm::ivec2(100, 333)}) {
    const HeightField flat = makeField(size, 12.5F);
    const glm::ivec2 patches = patchGridFor(size).count;
    const Outcome outcome = follow(flat, lookAround(flat), unlimited(0.01));
    const std::string name = "flat, " + std::to_string(size.x) + " × " + std::to_string(size.y);
    table.row(name, "triangles for each patch", outcome.triangles / (patches.x * patches.y), 2);
    table.holds(name, outcome);
  }

  HeightField degrees = hills({97, 65});
  degrees.spacing = {1 / 3600.0, 1 / 3600.0};
  degrees.origin = {7.4, 43.7};
  table.reaches("geographic degrees, heights in metres", follow(degrees, lookAround(degrees), unlimited()));

  HeightField oblong = hills({65, 65});
  oblong.spacing = {1, 100};
  table.reaches("samples 1 m by 100 m apart", follow(oblong, lookAround(oblong), unlimited()));

  HeightField far = hills({65, 65});
  far.origin = {1e7, -1e7};
  table.reaches("10 000 km from the origin", follow(far, lookAround(far), unlimited()));
}

void sizes(Table& table) {
  for (const glm::ivec2 size : {glm::ivec2(1, 40), glm::ivec2(40, 1), glm::ivec2(0, 0)}) {
    const HeightField line = makeField(size, 3);
    const Outcome outcome = follow(line, {city::makeView({{0, 0, 10}, 0, 0, 0}, kFov, {640, 480})}, unlimited());
    const std::string name = std::to_string(size.x) + " × " + std::to_string(size.y) + " samples";
    table.row(name, "triangles", outcome.triangles, 0);
  }
  for (const glm::ivec2 size :
       {glm::ivec2(2, 2), glm::ivec2(2, 300), glm::ivec2(3, 2), glm::ivec2(66, 131), glm::ivec2(100, 37)}) {
    const HeightField field = hills(size);
    table.reaches(std::to_string(size.x) + " × " + std::to_string(size.y) + " samples",
                  follow(field, lookAround(field), unlimited()));
  }
}

void gaps(Table& table) {
  HeightField holes = hills({97, 97});
  city::Random random(7);
  for (int i = 0; i < 12; ++i) {
    const int x = static_cast<int>(random.below(90)), y = static_cast<int>(random.below(90));
    for (int dy = 0; dy < 5; ++dy)
      for (int dx = 0; dx < 7 - dy; ++dx) holes.at(x + dx, y + dy) = kNaN;
  }
  holes.at(50, 50) = std::numeric_limits<float>::infinity();
  table.reaches("holes without data", follow(holes, lookAround(holes), unlimited()));

  HeightField coast = hills({97, 97});
  for (int y = 0; y < 97; ++y)
    for (int x = 0; x < 97; ++x)
      if (x + 10 * std::sin(y * 0.3) < 48) coast.at(x, y) = kNaN;
  table.reaches("half without data", follow(coast, lookAround(coast), unlimited()));

  const HeightField nothing = makeField({33, 33}, kNaN);
  table.row("all without data", "triangles",
            follow(nothing, {city::makeView({{0, 0, 10}, 0, 0, 0}, kFov, {640, 480})}, unlimited()).triangles, 0);

  HeightField lone = makeField({33, 33}, kNaN);
  lone.at(10, 10) = lone.at(20, 20) = 100;
  table.row("samples without neighbours", "triangles", follow(lone, lookAround(lone), unlimited(0.1)).triangles, 0);
}

void budgets(Table& table) {
  const HeightField field = hills({129, 129});
  for (const uint32_t budget : {0U, 2U, 3U, 100U, 2000U}) {
    const Outcome outcome = follow(field, lookAround(field), withBudget(budget));
    const std::string name = "budget " + std::to_string(budget);
    table.holds(name, outcome);
    table.row(name, "triangles", outcome.triangles, std::max(budget, 2U));  // of one patch
  }
  table.reaches("budget of more than all triangles", follow(field, lookAround(field), withBudget(10 * 2 * 128 * 128)));
}

void views(Table& table) {
  const HeightField field = hills({129, 129});
  table.reaches("a teleport each frame", follow(field, jumps(field, 40, 11), unlimited(1)));
  table.holds("a teleport each frame, budget 500", follow(field, jumps(field, 40, 12), withBudget(500)));

  const ViewState plain = viewOver(field, {0.5, 0.5}, 2, 0.3);
  std::vector<ViewState> odd(8, plain);
  odd[0].eye.z -= 2;    // on the ground itself
  odd[1].eye.z -= 500;  // under it
  odd[2] = viewOver(field, {0.5, 0.5}, 5, 0, -std::numbers::pi / 2);
  odd[3] = viewOver(field, {0.5, 0.5}, 50'000, 0, -std::numbers::pi / 2);
  odd[4].verticalFov = city::kSmallestFov;
  odd[5].verticalFov = city::kLargestFov;
  odd[6].viewport = {16384, 1};
  odd[7].viewport = {1, 1};
  table.reaches("on, under and 50 km over the ground; narrowest and widest view", follow(field, odd, unlimited()));

  std::vector<ViewState> broken(3, plain);
  broken[1].eye.x = std::numeric_limits<double>::quiet_NaN();
  const ErrorTable errors = buildErrorTable(field);
  Roam roam(field, errors);
  const uint32_t before = roam.update(broken[0], unlimited()).triangleCount;
  const uint32_t during = roam.update(broken[1], unlimited()).triangleCount;
  const uint32_t after = roam.update(broken[2], unlimited()).triangleCount;
  table.row("an eye that is not a number", "triangles that changed",
            std::abs(static_cast<double>(during) - before) + std::abs(static_cast<double>(after) - before), 0);
}

}  // namespace

std::vector<StabilityRow> roamStability() {
  Table table;
  shapes(table);
  sizes(table);
  gaps(table);
  budgets(table);
  views(table);
  return std::move(table.rows);
}

}  // namespace vicus::terrain
