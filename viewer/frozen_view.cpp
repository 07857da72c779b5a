#include "viewer/frozen_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <utility>

#include "culling/frustum.hpp"
#include "culling/horizon.hpp"
#include "viewer/raw_gl.hpp"

namespace vicus::viewer {
namespace {

constexpr glm::u8vec4 kFrustumColour{255, 214, 60, 255}, kDrawnTile{90, 200, 110, 255},
    kDroppedTile{150, 150, 150, 255}, kOccluder{255, 140, 30, 255}, kHorizon{240, 60, 220, 255};
constexpr double kCurtain = 10;  // metres from the eye along the faces' axes

/// A line's end as the card gets it: metres from the frozen eye.
struct LineVertex {
  glm::vec3 position;
  glm::u8vec4 colour;
};

void addFrustum(const city::ViewState& view, double reach, std::vector<SceneLine>& lines) {
  const double up = std::tan(view.verticalFov / 2);
  const double right = up * view.viewport.x / std::max(view.viewport.y, 1);
  const auto corner = [&](int k, double distance) {
    const double x = k == 1 || k == 2 ? right : -right, y = k >= 2 ? up : -up;
    return view.eye + distance * (view.forward + x * view.right + y * view.up);
  };
  for (int k = 0; k < 4; ++k) lines.push_back({view.eye, corner(k, reach), kFrustumColour});
  for (double distance = reach; distance > reach / 20; distance /= 3)
    for (int k = 0; k < 4; ++k) lines.push_back({corner(k, distance), corner((k + 1) % 4, distance), kFrustumColour});
}

void addTile(const city::Aabbf& box, glm::u8vec4 colour, std::vector<SceneLine>& lines) {
  const glm::dvec3 a(box.min), b(box.max);
  const std::array<glm::dvec3, 4> top{{{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}};
  for (size_t k = 0; k < 4; ++k) lines.push_back({top[k], top[(k + 1) % 4], colour});
}

}  // namespace

std::vector<Fate> fatesOf(const city::City& city, const city::FramePlan& plan) {
  std::vector<Fate> fates(city.itemCount(), Fate::Drawn);
  for (const city::DroppedRange& dropped : plan.buildings.dropped) {
    const Fate fate = dropped.reason == city::DropReason::Occluded ? Fate::Hidden : Fate::OutsidePicture;
    std::fill_n(fates.begin() + city.itemOfBuilding(dropped.range.first), dropped.range.count, fate);
  }
  // The plan lists monuments that are drawn; why the others are not follows from where they stand.
  const culling::Frustum frustum = culling::frustumOf(plan.view);
  for (uint32_t i = 0; i < city.monuments.size(); ++i) {
    if (std::binary_search(plan.monuments.begin(), plan.monuments.end(), i)) continue;
    const culling::BoxTest test = culling::boxTestFor(frustum, city.monuments[i].bounds);
    uint32_t mask = test.allPlanes;
    const bool inside = culling::classify(test, city.monuments[i].bounds, mask) != culling::Containment::Outside;
    fates[city.itemOfMonument(i)] = inside ? Fate::Hidden : Fate::OutsidePicture;
  }
  return fates;
}

glm::u8vec4 tintOf(Fate fate) {
  switch (fate) {
    case Fate::OutsidePicture:
      return {52, 104, 214, 150};
    case Fate::Hidden:
      return {222, 58, 36, 165};
    case Fate::Drawn:
      break;
  }
  return {0, 0, 0, 0};
}

std::vector<SceneLine> linesOf(const city::City& city, const city::FramePlan& plan) {
  std::vector<SceneLine> lines;
  for (uint32_t t = 0; t < city.tiles.size(); ++t) {
    if (city.tiles[t].bounds.empty()) continue;
    const bool drawn = std::binary_search(plan.tiles.begin(), plan.tiles.end(), t);
    addTile(city.tiles[t].bounds, drawn ? kDrawnTile : kDroppedTile, lines);
  }
  const glm::dvec2 size(city.extent.empty() ? glm::dvec3(0) : city.extent.size());
  addFrustum(plan.view, std::clamp(0.4 * std::max(size.x, size.y), 50.0, 5000.0), lines);
  return lines;
}

std::vector<SceneLine> linesOf(const culling::CullMapView& map, const glm::dvec3& eye) {
  std::vector<SceneLine> lines;
  for (const culling::CullMapView::Line& line : map.occluders) lines.push_back({line.a, line.b, kOccluder});
  const auto perFace = static_cast<int>(map.slopes.size()) / culling::kFaces;
  for (int k = 0; k < perFace * culling::kFaces; ++k) {
    const auto slope = static_cast<double>(map.slopes[static_cast<size_t>(k)]);
    if (!std::isfinite(slope)) continue;
    // A column's edge over its whole width, turned back from its face.
    const auto end = [&](int column) {
      glm::dvec2 p(kCurtain, kCurtain * (2.0 * column / perFace - 1));
      for (int face = 0; face < k / perFace; ++face) p = {-p.y, p.x};
      return eye + glm::dvec3(p, kCurtain * slope);
    };
    lines.push_back({end(k % perFace), end(k % perFace + 1), kHorizon});
  }
  const auto cells = static_cast<int>(map.cells);
  const auto corner = [&](int x, int y) -> std::optional<glm::dvec3> {
    const float height = map.heights[static_cast<size_t>(y) * map.cells + static_cast<size_t>(x)];
    if (!std::isfinite(height)) return std::nullopt;
    const glm::dvec2 cell(x - 0.5 * cells + 0.5, y - 0.5 * cells + 0.5);
    return eye + glm::dvec3(cell * map.cellSize, height);
  };
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const std::optional<glm::dvec3> here = corner(x, y);
      if (!here) continue;
      for (const glm::ivec2 next : {glm::ivec2(x + 1, y), glm::ivec2(x, y + 1)})
        if (next.x < cells && next.y < cells)
          if (const std::optional<glm::dvec3> there = corner(next.x, next.y))
            lines.push_back({*here, *there, kHorizon});
    }
  return lines;
}

struct FrozenView::Impl {
  const city::City& city;
  city::FramePlan plan;
  std::vector<glm::u8vec4> tints;  ///< by item id
  GLuint lineProgram = 0, tintProgram = 0, lineArray = 0, lineBuffer = 0, noArray = 0, texture = 0;
  GLsizei lineVertices = 0;

  explicit Impl(const city::City& c, city::FramePlan p) : city(c), plan(std::move(p)) {}
};

FrozenView::FrozenView(const city::City& city, city::FramePlan frozen, const culling::CullMapView& cullMap,
                       std::string& problem)
    : impl_(std::make_unique<Impl>(city, std::move(frozen))) {
  Impl& s = *impl_;
  for (const Fate fate : fatesOf(city, s.plan)) s.tints.push_back(tintOf(fate));
  std::vector<LineVertex> vertices;
  std::vector<SceneLine> lines = linesOf(city, s.plan);
  const std::vector<SceneLine> mapLines = linesOf(cullMap, s.plan.view.eye);
  lines.insert(lines.end(), mapLines.begin(), mapLines.end());
  for (const SceneLine& line : lines)
    for (const glm::dvec3& end : {line.a, line.b}) vertices.push_back({glm::vec3(end - s.plan.view.eye), line.colour});
  s.lineVertices = static_cast<GLsizei>(vertices.size());

  const GlStateGuard guard;
  s.lineProgram = linkProgram("lines.vert", "lines.frag", problem);
  s.tintProgram = linkProgram("tint.vert", "tint.frag", problem);
  glGenVertexArrays(1, &s.lineArray);
  glGenVertexArrays(1, &s.noArray);
  glGenBuffers(1, &s.lineBuffer);
  glBindVertexArray(s.lineArray);
  glBindBuffer(GL_ARRAY_BUFFER, s.lineBuffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(LineVertex)), vertices.data(),
               GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(LineVertex), nullptr);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(LineVertex),
                        reinterpret_cast<const void*>(offsetof(LineVertex, colour)));
  glGenTextures(1, &s.texture);
  glBindTexture(GL_TEXTURE_2D, s.texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

FrozenView::~FrozenView() {
  Impl& s = *impl_;
  glDeleteProgram(s.lineProgram);
  glDeleteProgram(s.tintProgram);
  glDeleteVertexArrays(1, &s.lineArray);
  glDeleteVertexArrays(1, &s.noArray);
  glDeleteBuffers(1, &s.lineBuffer);
  glDeleteTextures(1, &s.texture);
}

const city::FramePlan& FrozenView::frozen() const {
  return impl_->plan;
}

city::FramePlan FrozenView::planFrom(const city::ViewState& view) const {
  const Impl& s = *impl_;
  city::FramePlan plan = s.plan;
  plan.view = view;
  plan.stages.clear();
  plan.buildings.dropped.clear();
  plan.buildings.drawn.clear();
  if (!s.city.buildings.empty()) plan.buildings.drawn = {{0, static_cast<uint32_t>(s.city.buildings.size())}};
  plan.buildings.drawnCount = s.city.buildings.size();
  plan.monuments.clear();
  for (uint32_t i = 0; i < s.city.monuments.size(); ++i) plan.monuments.push_back(i);
  return plan;
}

void FrozenView::drawLines(const city::ViewState& view) const {
  const Impl& s = *impl_;
  if (s.lineProgram == 0) return;
  const GlStateGuard guard;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDepthMask(GL_FALSE);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glUseProgram(s.lineProgram);
  const glm::mat4 clip(city::clipFromEyeRelative(view));
  const glm::vec3 offset(s.plan.view.eye - view.eye);
  glUniformMatrix4fv(glGetUniformLocation(s.lineProgram, "clipFromEyeRelative"), 1, GL_FALSE, glm::value_ptr(clip));
  glUniform3fv(glGetUniformLocation(s.lineProgram, "placeFromEye"), 1, glm::value_ptr(offset));
  glBindVertexArray(s.lineArray);
  glDrawArrays(GL_LINES, 0, s.lineVertices);
}

void FrozenView::drawTints(Renderer& renderer, const ItemBuffer& items) const {
  const Impl& s = *impl_;
  if (s.tintProgram == 0 || items.ids.empty()) return;
  std::vector<glm::u8vec4> pixels(items.ids.size(), glm::u8vec4(0));
  for (size_t p = 0; p < pixels.size(); ++p)
    if (items.ids[p] < s.tints.size()) pixels[p] = s.tints[items.ids[p]];
  renderer.drawOver([&](glm::ivec2) {
    const GlStateGuard guard;
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(s.tintProgram);
    glBindTexture(GL_TEXTURE_2D, s.texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, items.width, items.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glUniform1i(glGetUniformLocation(s.tintProgram, "tints"), 0);
    glBindVertexArray(s.noArray);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  });
}

}  // namespace vicus::viewer
