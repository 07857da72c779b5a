// One description of each type serves both directions: `visit(archive, value)` names its fields in order, and the
// archive writes or reads them.
#include "assets/cache/city_codec.hpp"

#include <array>
#include <cstring>
#include <type_traits>
#include <utility>

namespace vicus::assets {
namespace {

/// Types copied as they lie in memory. None has padding, so equal values give equal bytes.
template <typename T>
constexpr bool kPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <>
constexpr bool kPlain<glm::vec2> = true;
template <>
constexpr bool kPlain<glm::vec3> = true;
template <>
constexpr bool kPlain<glm::dvec2> = true;
template <>
constexpr bool kPlain<glm::dvec3> = true;
template <>
constexpr bool kPlain<glm::ivec2> = true;
template <>
constexpr bool kPlain<city::Aabb> = sizeof(city::Aabb) == 6 * 8;
template <>
constexpr bool kPlain<city::Aabbf> = sizeof(city::Aabbf) == 6 * 4;
template <>
constexpr bool kPlain<city::Range> = sizeof(city::Range) == 2 * 4;
template <>
constexpr bool kPlain<city::Vertex> = sizeof(city::Vertex) == 5 * 4 + 4 + 2 + 2 + 4;
template <>
constexpr bool kPlain<city::ExternalItem> = sizeof(city::ExternalItem) == 8 + 4;
template <>
constexpr bool kPlain<city::Level> = sizeof(city::Level) == 2 * 4 + 8;
template <>
constexpr bool kPlain<city::OccluderLine> = sizeof(city::OccluderLine) == 6 * 4;
template <>
constexpr bool kPlain<city::Instance> = sizeof(city::Instance) == 3 * 8 + 4 * 4;
template <>
constexpr bool kPlain<city::BoundsNode> = sizeof(city::BoundsNode) == 6 * 4 + 8 + 2 * 4;
template <>
constexpr bool kPlain<city::Tile> = sizeof(city::Tile) == 6 * 4 + 2 * 8;
template <>
constexpr bool kPlain<city::StreetGraph::Node> = sizeof(city::StreetGraph::Node) == 3 * 8;
template <>
constexpr bool kPlain<city::Tour::Key> = sizeof(city::Tour::Key) == 6 * 8;
template <>
constexpr bool kPlain<glm::quat> = true;
template <>
constexpr bool kPlain<glm::mat4> = true;
template <>
constexpr bool kPlain<city::JointTransform> = sizeof(city::JointTransform) == 10 * 4;
template <>
constexpr bool kPlain<city::AvatarVertex> = sizeof(city::AvatarVertex) == 7 * 4;
template <>
constexpr bool kPlain<city::Dress> = sizeof(city::Dress) == city::kDressParts * 3 * 4;
template <>
constexpr bool kPlain<city::Environment> = sizeof(city::Environment) == 3 * 8;

class Writer {
 public:
  static constexpr bool kReads = false;
  void bytes(const void* data, size_t size) { out_.append(static_cast<const char*>(data), size); }
  uint64_t count(uint64_t n, size_t) {
    bytes(&n, sizeof n);
    return n;
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

/// Invariant: never reads beyond its bytes; once something was missing it gives zeros and `good` is false.
class Reader {
 public:
  static constexpr bool kReads = true;
  explicit Reader(std::string_view in) : in_(in) {}
  void bytes(void* data, size_t size) {
    if (size > in_.size()) good_ = false;
    if (!good_) {
      std::memset(data, 0, size);
      return;
    }
    std::memcpy(data, in_.data(), size);
    in_.remove_prefix(size);
  }
  /// Number of entries that follow, each at least `least` bytes long.
  uint64_t count(uint64_t, size_t least) {
    uint64_t n = 0;
    bytes(&n, sizeof n);
    if (n > in_.size() / least) good_ = false;
    return good_ ? n : 0;
  }
  bool good() const { return good_; }
  bool finished() const { return good_ && in_.empty(); }

 private:
  std::string_view in_;
  bool good_ = true;
};

template <typename Archive, typename T>
requires kPlain<std::remove_const_t<T>>
void visit(Archive& a, T& value) {
  if constexpr (std::is_same_v<std::remove_const_t<T>, bool> && Archive::kReads) {
    uint8_t byte = 0;
    a.bytes(&byte, 1);
    value = byte != 0;
  } else {
    a.bytes(&value, sizeof value);
  }
}

template <typename Archive, typename T>
requires std::is_same_v<std::remove_const_t<T>, std::string>
void visit(Archive& a, T& text) {
  const uint64_t size = a.count(text.size(), 1);
  if constexpr (Archive::kReads) text.resize(size);
  a.bytes(text.data(), size);
}

template <typename T>
struct IsVector : std::false_type {};
template <typename T>
struct IsVector<std::vector<T>> : std::true_type {};
template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <typename T>
struct IsArray : std::false_type {};
template <typename T, size_t N>
struct IsArray<std::array<T, N>> : std::bool_constant<!kPlain<std::array<T, N>>> {};
template <typename T>
struct IsPair : std::false_type {};
template <typename A, typename B>
struct IsPair<std::pair<A, B>> : std::true_type {};

// Declared before lists and options of them are visited.
template <typename Archive, typename T>
requires IsVector<std::remove_const_t<T>>::value void visit(Archive& a, T& list);
template <typename Archive, typename T>
requires IsOptional<std::remove_const_t<T>>::value void visit(Archive& a, T& option);
template <typename Archive, typename T>
requires IsArray<std::remove_const_t<T>>::value void visit(Archive& a, T& array);
template <typename Archive, typename T>
requires IsPair<std::remove_const_t<T>>::value void visit(Archive& a, T& pair);
template <typename Archive, typename T>
requires std::is_class_v<T> && requires(Archive& a, T& v) {
  fields(a, v);
}
void visit(Archive& a, T& value);

template <typename Archive, typename... Fields>
void visitAll(Archive& a, Fields&... values) {
  (visit(a, values), ...);
}

/// The fields of a type, all of them in order: a structured binding, so that a field that is added and not named here
/// does not compile. A template, so that it serves the const value that is written and the one that is read.
#define VICUS_FIELDS(TYPE, ...)                         \
  template <typename Archive, typename T>               \
  requires std::is_same_v<std::remove_const_t<T>, TYPE> \
  void fields(Archive& a, T& value) {                   \
    auto& [__VA_ARGS__] = value;                        \
    visitAll(a, __VA_ARGS__);                           \
  }

VICUS_FIELDS(city::Material, name, source, metresPerRepeat, tint, tintVariation, specular, repeat)
VICUS_FIELDS(city::Plane, kind, solid, baseTexture, lodTexture, normal, cut, flat, externalGeometry, externalOpenings)
VICUS_FIELDS(city::BuildingGeometry, name, vertices, indices, fullDetail, levels, planes, externalGeometry,
             externalOpenings, occluders, footprint, bounds, height)
VICUS_FIELDS(city::InstanceSet, instances, bounds, nodes)
VICUS_FIELDS(city::TriangleMesh, vertices, indices)
VICUS_FIELDS(city::MeshGeometry, name, mesh, bounds)
VICUS_FIELDS(city::Monument, name, mesh, position, heading, attributes, bounds)
VICUS_FIELDS(city::TileGrid, origin, tileSize, size)
VICUS_FIELDS(city::HeightField, origin, spacing, size, heights, minHeight, maxHeight)
VICUS_FIELDS(city::GroundCover, origin, spacing, size, kinds)
VICUS_FIELDS(city::WaterBody, name, level, points, indices)
VICUS_FIELDS(city::StreetGraph::Edge, from, to, width, kind, name)
VICUS_FIELDS(city::StreetGraph, nodes, edges)
VICUS_FIELDS(city::Tour, name, keys, jumps)
VICUS_FIELDS(city::Joint, name, parent, rest)
VICUS_FIELDS(city::Skeleton, joints)
VICUS_FIELDS(city::Track, joint, interpolation, rotationTimes, translationTimes, scaleTimes, rotations, translations,
             scales)
VICUS_FIELDS(city::Clip, name, duration, loops, stride, tracks)
VICUS_FIELDS(city::AvatarMesh, vertices, indices)
VICUS_FIELDS(city::Character, name, skeleton, jointFromSkin, levels, clips, dresses, bounds, carries)
VICUS_FIELDS(city::WalkRoute::Point, position, free, deck)
VICUS_FIELDS(city::WalkRoute, points, step)
VICUS_FIELDS(city::StandingPlace, position, heading, group)
VICUS_FIELDS(city::Person, character, role, route, start, speed, side, scale, dress, position, heading)
VICUS_FIELDS(city::People, characters, routes, places, placed, count, seed)
VICUS_FIELDS(city::City, name, origin, crs, extent, materials, buildingTypes, buildings, treeTypes, trees, meshes,
             monuments, grid, tiles, terrain, groundCover, water, streets, tours, people, attributes, environment)
VICUS_FIELDS(city::Diagnostic, severity, file, place, message)
VICUS_FIELDS(city::LeftOut, what, count, why)
VICUS_FIELDS(city::Diagnostics, messages, leftOut)
VICUS_FIELDS(CachedCity, cachedCity, diagnostics)
#undef VICUS_FIELDS

template <typename Archive, typename T>
requires IsVector<std::remove_const_t<T>>::value void visit(Archive& a, T& list) {
  using Value = typename std::remove_const_t<T>::value_type;
  if constexpr (kPlain<Value>) {
    const uint64_t count = a.count(list.size(), sizeof(Value));
    if constexpr (Archive::kReads) list.resize(count);
    if (count > 0) a.bytes(list.data(), count * sizeof(Value));
  } else {
    const uint64_t count = a.count(list.size(), 1);
    if constexpr (Archive::kReads) {
      // One at a time: a damaged count must not ask for memory that the bytes cannot fill.
      for (uint64_t i = 0; i < count && a.good(); ++i) visit(a, list.emplace_back());
    } else {
      for (const auto& value : list) visit(a, value);
    }
  }
}

template <typename Archive, typename T>
requires IsOptional<std::remove_const_t<T>>::value void visit(Archive& a, T& option) {
  if (a.count(option.has_value() ? 1 : 0, 1) == 0) return;
  if constexpr (Archive::kReads) option.emplace();
  visit(a, *option);
}

template <typename Archive, typename T>
requires IsArray<std::remove_const_t<T>>::value void visit(Archive& a, T& array) {
  for (auto& value : array) visit(a, value);
}

template <typename Archive, typename T>
requires IsPair<std::remove_const_t<T>>::value void visit(Archive& a, T& pair) {
  visitAll(a, pair.first, pair.second);
}

template <typename Archive, typename T>
requires std::is_class_v<T> && requires(Archive& a, T& v) {
  fields(a, v);
}
void visit(Archive& a, T& value) {
  fields(a, value);
}

}  // namespace

std::string encodeCity(const CachedCity& city) {
  Writer writer;
  visit(writer, city);
  return writer.take();
}

std::optional<CachedCity> decodeCity(std::string_view bytes) {
  Reader reader(bytes);
  std::optional<CachedCity> city(std::in_place);
  visit(reader, *city);
  if (!reader.finished()) city.reset();
  return city;
}

}  // namespace vicus::assets
