#include "houselod/house_types.hpp"

namespace vicus::houselod {

HouseTypes lookAtTypes(std::span<const city::BuildingGeometry> types, const city::Knobs& knobs) {
  HouseTypes out;
  const double megabytes = knobs.has("house_lod.picture_mb") ? knobs["house_lod.picture_mb"] : 0;
  out.pictures = picturesWithin(types, megabytes);
  out.levels.reserve(types.size());
  for (size_t t = 0; t < types.size(); ++t) {
    out.levels.push_back(levelsOf(types[t]));
    if (out.pictures.detail[t] > 0) out.levels.back().detail = out.pictures.detail[t];
  }
  return out;
}

}  // namespace vicus::houselod
