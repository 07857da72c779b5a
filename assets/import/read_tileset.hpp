/// 3D Tiles 1.0 as a source of buildings: tileset.json with b3dm and glb content.
#pragma once

#include <string>
#include <string_view>

#include "assets/import/source.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

/// Does a JSON text look like a tileset? It has the members "geometricError" and "root".
bool isTileset(std::string_view text);

/// The finest content of every tile (where tiles refine by adding, that of all): one building for each batch id, else
/// for each tile, with attributes from the batch table. Earth-centred coordinates become longitude, latitude and height
/// over the ellipsoid; others are metres of their own. Reads triangles with positions, base colours and
/// pictures, also compressed with Draco; instanced and point content is left out by name.
Source readTileset(const std::string& file, city::Diagnostics& diagnostics);

/// The same for one b3dm file alone.
Source readBatchedModel(const std::string& file, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
