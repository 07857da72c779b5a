/// CityJSON written by tests: boxes of 10 × 8 × 6 m.
#pragma once

#include <string>
#include <vector>

#include "import_files.hpp"

namespace vicus::assets {

/// CityJSON 2.0 in metres (Lambert-93), vertices in millimetres from (600 000, 6 500 000, 100).
inline std::string cityJson(
    const std::string& objects, const std::string& vertices,
    const std::string& metadata = R"({"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/2154"})") {
  return R"({"type":"CityJSON","version":"2.0","metadata":)" + metadata +
         R"(,"transform":{"scale":[0.001,0.001,0.001],"translate":[600000,6500000,100]},"CityObjects":{)" + objects +
         R"(},"vertices":)" + vertices + "}";
}

/// Corners of a box of 10 × 8 × 6 m, then those of a window of 2 × 2 m in its southern wall.
inline const std::string kBox =
    "[[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],[0,0,6000],[10000,0,6000],[10000,8000,6000],[0,8000,6000],"
    "[4000,0,2000],[6000,0,2000],[6000,0,4000],[4000,0,4000]]";
inline const std::string kGround = "[[0,3,2,1]]", kSouth = "[[0,1,5,4]]", kEast = "[[1,2,6,5]]", kNorth = "[[2,3,7,6]]",
                         kWest = "[[3,0,4,7]]", kTop = "[[4,5,6,7]]";

inline std::string join(const std::vector<std::string>& surfaces) {
  std::string out;
  for (const std::string& s : surfaces) out += (out.empty() ? "" : ",") + s;
  return "[" + out + "]";
}

inline std::string object(const std::string& id, const std::string& type, const std::string& geometry,
                          const std::string& more = "") {
  return "\"" + id + R"(":{"type":")" + type + "\"" + more + R"(,"geometry":[)" + geometry + "]}";
}

inline std::string geometry(const std::string& type, const std::string& lod, const std::string& boundaries,
                            const std::string& more = "") {
  return R"({"type":")" + type + R"(","lod":")" + lod + R"(","boundaries":)" + boundaries + more + "}";
}

inline std::string solid(const std::vector<std::string>& surfaces, const std::string& more = "") {
  return geometry("Solid", "2", "[" + join(surfaces) + "]", more);
}

inline LoadResult loadText(const std::string& text, const LoadOptions& options = {}) {
  const TemporaryFolder folder;
  return load(folder.write("town.city.json", text), options);
}

}  // namespace vicus::assets
