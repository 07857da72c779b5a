/// GEOS with owners.
#pragma once

#include <geos_c.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "assets/import/polygon.hpp"

namespace vicus::assets {

/// A GEOS handle for one thread's use, silent.
class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {
    GEOSContext_setNoticeMessageHandler_r(
        handle_, [](const char*, void*) {}, nullptr);
    GEOSContext_setErrorMessageHandler_r(
        handle_, [](const char*, void*) {}, nullptr);
  }
  ~Geos() { GEOS_finish_r(handle_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  GEOSContextHandle_t handle() const { return handle_; }

  auto own(GEOSGeometry* geometry) const {
    const auto destroy = [handle = handle_](GEOSGeometry* g) {
      if (g) GEOSGeom_destroy_r(handle, g);
    };
    return std::unique_ptr<GEOSGeometry, decltype(destroy)>(geometry, destroy);
  }

  GEOSGeometry* polygon(const Polygon& p) const {
    std::vector<GEOSGeometry*> rings;
    for (const Ring& ring : p.rings) {
      GEOSCoordSequence* points = GEOSCoordSeq_create_r(handle_, static_cast<unsigned>(ring.size() + 1), 2);
      for (size_t i = 0; i <= ring.size(); ++i) {
        const glm::dvec2& q = ring[i % ring.size()];
        GEOSCoordSeq_setXY_r(handle_, points, static_cast<unsigned>(i), q.x, q.y);
      }
      rings.push_back(GEOSGeom_createLinearRing_r(handle_, points));
    }
    if (rings.empty() || std::find(rings.begin(), rings.end(), nullptr) != rings.end()) return nullptr;
    return GEOSGeom_createPolygon_r(handle_, rings[0], rings.data() + 1, static_cast<unsigned>(rings.size() - 1));
  }

  Ring ring(const GEOSGeometry* lineRing) const {
    Ring out;
    const GEOSCoordSequence* points = GEOSGeom_getCoordSeq_r(handle_, lineRing);
    unsigned size = 0;
    if (points) GEOSCoordSeq_getSize_r(handle_, points, &size);
    for (unsigned i = 0; i + 1 < size; ++i) {
      glm::dvec2 p;
      GEOSCoordSeq_getXY_r(handle_, points, i, &p.x, &p.y);
      out.push_back(p);
    }
    return out;
  }

  /// Appends every polygon within a geometry of any kind.
  void collect(const GEOSGeometry* geometry, std::vector<Polygon>& out) const {
    const int type = GEOSGeomTypeId_r(handle_, geometry);
    if (type == GEOS_POLYGON) {
      if (GEOSisEmpty_r(handle_, geometry)) return;
      Polygon p;
      p.rings.push_back(ring(GEOSGetExteriorRing_r(handle_, geometry)));
      for (int i = 0; i < GEOSGetNumInteriorRings_r(handle_, geometry); ++i)
        p.rings.push_back(ring(GEOSGetInteriorRingN_r(handle_, geometry, i)));
      out.push_back(std::move(p));
    } else if (type == GEOS_MULTIPOLYGON || type == GEOS_GEOMETRYCOLLECTION) {
      for (int i = 0; i < GEOSGetNumGeometries_r(handle_, geometry); ++i)
        collect(GEOSGetGeometryN_r(handle_, geometry, i), out);
    }
  }

 private:
  GEOSContextHandle_t handle_;
};

}  // namespace vicus::assets
