#include "houselod/bake.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace vicus::houselod {
namespace {

using glm::ivec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr int kAcross = 2;  ///< samples of a texel, across and up

/// What one sample sees: linear light and specular share.
struct Sample {
  vec4 seen{0};
  float before = -std::numeric_limits<float>::infinity();  ///< metres before the wall
};

vec4 texelAt(const BakedFrom& m, size_t level, int size, int x, int y) {
  const uint8_t* p =
      m.levels[level].data() + 4 * (static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x));
  return vec4(p[0], p[1], p[2], p[3]) * (1.0f / 255);
}

/// The material at `uv` repeats, averaged over about `footprint` repeats; alpha of the picture in w.
vec4 look(const BakedFrom& m, vec2 uv, float footprint) {
  if (m.levels.empty() || m.size <= 0) return {vec3(0.25f) * m.tint, 1};
  const float texels = std::max(footprint * static_cast<float>(m.size), 1.0f);
  const size_t level = std::min(static_cast<size_t>(std::log2(texels) + 0.5f), m.levels.size() - 1);
  const int size = std::max(m.size >> level, 1);
  const vec2 at = uv * static_cast<float>(size) - 0.5f;
  const vec2 low = glm::floor(at), t = at - low;
  const auto fetch = [&](int dx, int dy) {
    int x = static_cast<int>(std::clamp(low.x, -1e9f, 1e9f)) + dx,
        y = static_cast<int>(std::clamp(low.y, -1e9f, 1e9f)) + dy;
    if (m.repeat)
      x &= size - 1, y &= size - 1;
    else
      x = std::clamp(x, 0, size - 1), y = std::clamp(y, 0, size - 1);
    return texelAt(m, level, size, x, y);
  };
  const vec4 root = glm::mix(glm::mix(fetch(0, 0), fetch(1, 0), t.x), glm::mix(fetch(0, 1), fetch(1, 1), t.x), t.y);
  return {vec3(root) * vec3(root) * m.tint, root.w};
}

/// The samples of one wall.
class Canvas {
 public:
  Canvas(const PlaneFrame& frame, ivec2 texels)
      : frame_(frame), size_(texels * kAcross), samples_(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y)) {
    // Texel centres lie from edge to edge (onPage), so a picture of one texel stands for all of the wall.
    perMetre_ = vec2(glm::max(texels - 1, ivec2(1)) * kAcross) / frame.size;
    shift_ = vec2(0.5f * kAcross) * vec2(texels.x > 1 ? 1 : 0, texels.y > 1 ? 1 : 0);
  }

  void draw(const city::BuildingGeometry& g, const city::Range& indices, std::span<const BakedFrom> materials) {
    for (uint32_t i = indices.first; i + 2 < indices.end(); i += 3)
      triangle(g.vertices[g.indices[i]], g.vertices[g.indices[i + 1]], g.vertices[g.indices[i + 2]], materials);
  }

  /// A texel's mean; texels that nothing covers get the mean of the covered ones.
  std::vector<uint8_t> resolved() const {
    const ivec2 texels = size_ / kAcross;
    std::vector<vec4> means(static_cast<size_t>(texels.x) * static_cast<size_t>(texels.y), vec4(0));
    std::vector<bool> covered(means.size(), false);
    vec4 all(0);
    float count = 0;
    for (int y = 0; y < texels.y; ++y)
      for (int x = 0; x < texels.x; ++x) {
        vec4 sum(0);
        float here = 0;
        for (int k = 0; k < kAcross * kAcross; ++k) {
          const Sample& s = at(x * kAcross + k % kAcross, y * kAcross + k / kAcross);
          if (std::isfinite(s.before)) sum += s.seen, here += 1;
        }
        if (here <= 0) continue;
        const size_t i = static_cast<size_t>(y) * static_cast<size_t>(texels.x) + static_cast<size_t>(x);
        means[i] = sum / here, covered[i] = true;
        all += means[i], count += 1;
      }
    std::vector<uint8_t> out(4 * means.size());
    for (size_t i = 0; i < means.size(); ++i) {
      const vec4 mean = covered[i] ? means[i] : count > 0 ? all / count : vec4(0.25f, 0.25f, 0.25f, 0);
      for (int c = 0; c < 3; ++c)
        out[4 * i + static_cast<size_t>(c)] =
            static_cast<uint8_t>(255 * std::sqrt(std::clamp(mean[c], 0.0f, 1.0f)) + 0.5f);
      out[4 * i + 3] = static_cast<uint8_t>(255 * std::clamp(mean.w, 0.0f, 1.0f) + 0.5f);
    }
    return out;
  }

 private:
  struct Corner {
    vec2 at;
    float before;
    vec2 uv;
  };
  Corner cornerOf(const city::Vertex& v) const {
    const vec3 d = v.position - frame_.origin;
    return {vec2(glm::dot(d, frame_.u), glm::dot(d, frame_.v)) * perMetre_ + shift_, glm::dot(d, frame_.normal), v.uv};
  }
  const Sample& at(int x, int y) const {
    return samples_[static_cast<size_t>(y) * static_cast<size_t>(size_.x) + static_cast<size_t>(x)];
  }

  void triangle(const city::Vertex& va, const city::Vertex& vb, const city::Vertex& vc,
                std::span<const BakedFrom> materials) {
    const Corner a = cornerOf(va), b = cornerOf(vb), c = cornerOf(vc);
    const vec2 ab = b.at - a.at, ac = c.at - a.at;
    const float area = ab.x * ac.y - ab.y * ac.x;
    if (!(area > 1e-6f)) return;  // seen from its edge or its back
    static const BakedFrom kGrey;
    const BakedFrom& material = va.material < materials.size() ? materials[va.material] : kGrey;
    const vec2 repeats = 1.0f / glm::max(material.metresPerRepeat, vec2(1e-6f));
    // How many repeats a sample's step covers, by the larger axis.
    const vec2 du = ((b.uv - a.uv) * ac.y - (c.uv - a.uv) * ab.y) / area * repeats;
    const vec2 dv = ((c.uv - a.uv) * ab.x - (b.uv - a.uv) * ac.x) / area * repeats;
    const float footprint = std::max(glm::length(du), glm::length(dv));

    const vec2 low = glm::min(glm::min(a.at, b.at), c.at), high = glm::max(glm::max(a.at, b.at), c.at);
    const auto first = [](float v, int end) {
      return static_cast<int>(std::clamp(std::floor(v), 0.0f, static_cast<float>(end)));
    };
    // Outermost samples lie half a texel beyond the wall's edges: they see what is at the edge.
    const ivec2 from(low.x <= shift_.x + 1e-3f ? 0 : first(low.x - 0.5f, size_.x),
                     low.y <= shift_.y + 1e-3f ? 0 : first(low.y - 0.5f, size_.y));
    const vec2 far = vec2(size_) - shift_ - 1e-3f;
    const ivec2 to(high.x >= far.x ? size_.x : first(high.x + 1.5f, size_.x),
                   high.y >= far.y ? size_.y : first(high.y + 1.5f, size_.y));
    for (int y = from.y; y < to.y; ++y)
      for (int x = from.x; x < to.x; ++x) {
        const vec2 p = glm::clamp(vec2(x, y) + 0.5f, shift_, vec2(size_) - shift_) - a.at;
        const float s = (p.x * ac.y - p.y * ac.x) / area, t = (ab.x * p.y - ab.y * p.x) / area;
        constexpr float kEdge = 1e-4f;
        if (s < -kEdge || t < -kEdge || s + t > 1 + kEdge) continue;
        Sample& sample = samples_[static_cast<size_t>(y) * static_cast<size_t>(size_.x) + static_cast<size_t>(x)];
        const float before = a.before + s * (b.before - a.before) + t * (c.before - a.before);
        if (before < sample.before) continue;
        const vec4 colour = look(material, (a.uv + s * (b.uv - a.uv) + t * (c.uv - a.uv)) * repeats, footprint);
        if (colour.w < 0.5f) continue;
        sample = {vec4(vec3(colour), material.specular), before};
      }
  }

  const PlaneFrame& frame_;
  ivec2 size_;
  vec2 perMetre_{1}, shift_{0};
  std::vector<Sample> samples_;
};

}  // namespace

void bakePicture(const city::BuildingGeometry& type, const TexturePlan& plan, const PlanePicture& picture,
                 std::span<const BakedFrom> materials, std::span<uint8_t> page) {
  const city::Plane& plane = type.planes[picture.plane];
  const PlaneFrame frame = planeFrame(type, plane);
  Canvas canvas(frame, picture.size);
  canvas.draw(type, plane.cut, materials);
  for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i)
    canvas.draw(type, type.externalOpenings[i].indices, materials);
  for (uint32_t i = plane.externalGeometry.first; i < plane.externalGeometry.end(); ++i)
    canvas.draw(type, type.externalGeometry[i].indices, materials);
  const std::vector<uint8_t> pixels = canvas.resolved();

  // To the margins with the picture's last column and row, so that coarser levels mix in nothing else.
  const ivec2 room =
      glm::min((picture.size + kPictureGrid - 1) / kPictureGrid * kPictureGrid, plan.pageSize - picture.corner);
  for (int y = 0; y < room.y; ++y)
    for (int x = 0; x < room.x; ++x) {
      const size_t from = static_cast<size_t>(std::min(y, picture.size.y - 1)) * static_cast<size_t>(picture.size.x) +
                          static_cast<size_t>(std::min(x, picture.size.x - 1));
      const size_t to = static_cast<size_t>(picture.corner.y + y) * static_cast<size_t>(plan.pageSize) +
                        static_cast<size_t>(picture.corner.x + x);
      std::copy_n(&pixels[4 * from], 4, &page[4 * to]);
    }
}

std::vector<std::vector<uint8_t>> pageLevels(std::vector<uint8_t> page, int pageSize, int size) {
  std::array<float, 256> square{};
  for (size_t i = 0; i < square.size(); ++i) square[i] = static_cast<float>(i * i);
  const auto halved = [&](const std::vector<uint8_t>& from, int half) {
    const auto row = static_cast<size_t>(half) * 2;
    std::vector<uint8_t> to(4 * static_cast<size_t>(half) * static_cast<size_t>(half));
    for (size_t y = 0; y < static_cast<size_t>(half); ++y)
      for (size_t x = 0; x < static_cast<size_t>(half); ++x) {
        const uint8_t* p = &from[4 * (2 * y * row + 2 * x)];
        uint8_t* out = &to[4 * (y * static_cast<size_t>(half) + x)];
        const uint8_t *right = p + 4, *up = p + 4 * row, *across = up + 4;
        for (size_t c = 0; c < 3; ++c)
          out[c] = static_cast<uint8_t>(
              std::sqrt(0.25f * (square[p[c]] + square[right[c]] + square[up[c]] + square[across[c]])) + 0.5f);
        out[3] = static_cast<uint8_t>((p[3] + right[3] + up[3] + across[3] + 2) / 4);
      }
    return to;
  };
  for (; pageSize > size; pageSize /= 2) page = halved(page, pageSize / 2);
  if (pageSize < size) {
    const int times = size / pageSize;
    std::vector<uint8_t> large(4 * static_cast<size_t>(size) * static_cast<size_t>(size));
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        std::copy_n(&page[4 * (static_cast<size_t>(y / times) * static_cast<size_t>(pageSize) +
                               static_cast<size_t>(x / times))],
                    4, &large[4 * (static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x))]);
    page = std::move(large);
  }
  std::vector<std::vector<uint8_t>> levels;
  levels.push_back(std::move(page));
  for (int half = size / 2; half > 0; half /= 2) levels.push_back(halved(levels.back(), half));
  return levels;
}

}  // namespace vicus::houselod
