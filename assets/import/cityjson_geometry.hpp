/// The geometry of CityJSON objects: vertices, surfaces, templates, appearances.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assets/import/source.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets::cityjson {

using Json = nlohmann::json;

/// A member of an object; null where there is none.
const Json& member(const Json& object, const char* name);
/// A string's text; empty for anything else.
std::string textOf(const Json& value);
/// A value as messages show it: scalars as they are, "a list" or "an object" for what may be large.
std::string shown(const Json& value);

/// One object's geometry at one level of detail.
struct Geometry {
  double lod = 0;
  bool points = false;            ///< a MultiPoint: `surfaces` holds one ring of points
  std::vector<Surface> surfaces;  ///< indices into GeometryReader::vertices
};

/// Says that something is wrong with an object; only the first complaint of each object is kept.
using Complain = std::function<void(const std::string& id, const std::string& message)>;

/// Reads the geometries of one JSON text. Invariant: every index in a Surface that it gives is one of `vertices`, whose
/// coordinates there are numbers.
class GeometryReader {
 public:
  /// `defaults` supplies what `root` itself does not have: the first line of a text sequence (transform, appearance,
  /// templates); may be `root`.
  GeometryReader(const Json& root, const Json& defaults, const std::string& file, Complain complain);

  /// False, with messages, where there are no vertices to read.
  bool readVertices(city::Diagnostics& diagnostics);
  /// Materials of surfaces, in the order of Surface::material: colours, then pictures.
  void readAppearance(city::Diagnostics& diagnostics);
  std::optional<Geometry> read(const std::string& id, const Json& geometry);

  const std::vector<glm::dvec3>& vertices() const { return vertices_; }
  const std::vector<SourceMaterial>& materials() const { return materials_; }

 private:
  /// What stands beside the boundaries, nested as these.
  struct Beside {
    const Json* semantics;
    const Json* textures;
    const Json* colours;
  };
  std::optional<Geometry> readInstance(const std::string& id, const Json& geometry);
  std::optional<Geometry> readShape(const std::string& id, const Json& geometry, std::span<const glm::dvec3> points);
  void readSurfaces(const std::string& id, const Json& boundaries, const Beside& beside, int depth, uint32_t& shell,
                    const std::vector<SurfaceKind>& kinds, std::span<const glm::dvec3> points,
                    std::vector<Surface>& out);
  std::optional<Surface> readSurface(const std::string& id, const Json& rings, std::span<const glm::dvec3> points);
  void paint(Surface& surface, const Json& textures, const Json& colour) const;
  const Json& fromEither(const char* name) const;

  const Json& root_;
  const Json& defaults_;
  const std::string& file_;
  Complain complain_;
  std::vector<glm::dvec3> vertices_;  ///< the text's own, then those of placed templates
  size_t ownVertices_ = 0;
  std::vector<glm::dvec3> templateVertices_;
  std::map<size_t, std::optional<Geometry>> templates_;
  std::vector<glm::vec2> textureVertices_;
  std::vector<SourceMaterial> materials_;
  std::vector<uint32_t> colourMaterials_, textureMaterials_;  ///< of each entry of the appearance; kNoMaterial: none
  std::string colourTheme_, textureTheme_;
};

}  // namespace vicus::assets::cityjson
