#include "avatars/impostor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "avatars/pose.hpp"

namespace vicus::avatars {
namespace {

using glm::vec2;
using glm::vec3;

/// One picture in the making: nearest wins.
struct Canvas {
  Impostor& into;
  int column, row;  // of the picture's first texel
  std::vector<float> depth;

  void triangle(const std::array<vec3, 3>& p, const std::array<uint8_t, 4>& colour) {
    const vec2 a(p[0]), b(p[1]), c(p[2]);
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (!(std::abs(area) > 1e-9F)) return;
    const int x0 = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
    const int x1 = std::min(kImpostorWidth - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
    const int y0 = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
    const int y1 = std::min(kImpostorHeight - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const vec2 q(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        const float wb = ((q.x - a.x) * (c.y - a.y) - (q.y - a.y) * (c.x - a.x)) / area;
        const float wc = ((b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x)) / area;
        if (wb < 0 || wc < 0 || wb + wc > 1) continue;
        const float z = p[0].z + wb * (p[1].z - p[0].z) + wc * (p[2].z - p[0].z);
        float& nearest = depth[static_cast<size_t>(y * kImpostorWidth + x)];
        if (z >= nearest) continue;
        nearest = z;
        uint8_t* texel = &into.rgba[4 * static_cast<size_t>((row + y) * into.width + column + x)];
        std::copy(colour.begin(), colour.end(), texel);
      }
  }
};

}  // namespace

Impostor makeImpostor(const city::Character& character) {
  Impostor out;
  out.rgba.assign(4 * static_cast<size_t>(out.width) * static_cast<size_t>(out.height), 0);
  if (!character.bounds.empty()) {
    const vec3 far = glm::max(glm::abs(character.bounds.min), glm::abs(character.bounds.max));
    out.halfWidth = std::max(far.x, far.y);
    out.bottom = std::min(character.bounds.min.z, 0.0F), out.top = std::max(character.bounds.max.z, 0.1F);
  }
  const city::AvatarMesh& mesh = character.levels[1].indices.empty() ? character.levels[0] : character.levels[1];
  const vec2 texels(static_cast<float>(kImpostorWidth) / (2 * out.halfWidth),
                    static_cast<float>(kImpostorHeight) / (out.top - out.bottom));
  city::Pose pose;
  std::vector<std::array<glm::vec4, 3>> matrices;
  std::vector<vec3> posed;
  for (size_t role = 0; role < city::kRoles; ++role)
    for (int phase = 0; phase < kImpostorPhases; ++phase) {
      const city::Clip& clip = character.clips[role];
      samplePose(character.skeleton, clip, clip.duration * (phase + 0.5) / kImpostorPhases, pose);
      matrices.clear(), posed.clear();
      addSkinMatrices(character, pose, matrices);
      for (const city::AvatarVertex& v : mesh.vertices) posed.push_back(skinned(v, matrices));
      for (int k = 0; k < kImpostorDirections; ++k) {
        const double angle = 2 * std::numbers::pi * k / kImpostorDirections;
        const vec2 toEye(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
        const vec2 right(-toEye.y, toEye.x);  // as the eye sees it
        Canvas canvas{out, k * kImpostorWidth, (static_cast<int>(role) * kImpostorPhases + phase) * kImpostorHeight,
                      std::vector<float>(static_cast<size_t>(kImpostorWidth) * kImpostorHeight,
                                         std::numeric_limits<float>::infinity())};
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
          std::array<vec3, 3> corners;
          for (size_t c = 0; c < 3; ++c) {
            const vec3& p = posed[mesh.indices[i + c]];
            corners[c] = {(glm::dot(vec2(p), right) + out.halfWidth) * texels.x, (p.z - out.bottom) * texels.y,
                          -glm::dot(vec2(p), toEye)};
          }
          const auto& colour = mesh.vertices[mesh.indices[i]].colour;
          canvas.triangle(corners, {colour[0], colour[1], colour[2],
                                    static_cast<uint8_t>((1 + std::min<int>(colour[3], city::kDressParts - 1)) * 28)});
        }
      }
    }
  return out;
}

}  // namespace vicus::avatars
