#include "assets/import/columns.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace vicus::assets {
namespace {

// Heights to the eaves come before heights to the ridge: walls end there.
constexpr auto kHeight = std::to_array<std::string_view>({"height",
                                                          "measuredheight",
                                                          "hauteur",
                                                          "buildingheight",
                                                          "bldgheight",
                                                          "heightm",
                                                          "relh",
                                                          "eavesheight",
                                                          "heighteaves",
                                                          "hoehe",
                                                          "hohe",
                                                          "altura",
                                                          "altezza",
                                                          "hoogte",
                                                          "hmean",
                                                          "hmedian",
                                                          "hmax",
                                                          "heightmax",
                                                          "maxheight",
                                                          "roofheight",
                                                          "relativeeavesheight",
                                                          "relativeridgeheight",
                                                          "estheight",
                                                          "buildheight",
                                                          "hgt",
                                                          "h"});
constexpr auto kStoreys = std::to_array<std::string_view>(
    {"buildinglevels", "levels", "storeysaboveground", "storeys", "stories", "numberoffloors", "numfloors", "floors",
     "nbetages", "nombredetages", "nbniveaux", "geschosse", "plantas", "piani", "bouwlagen", "storyht"});
constexpr auto kGround = std::to_array<std::string_view>({"ground",
                                                          "groundheight",
                                                          "groundz",
                                                          "zground",
                                                          "groundelevation",
                                                          "elevationground",
                                                          "altitudesol",
                                                          "altitudes",
                                                          "altsol",
                                                          "zminsol",
                                                          "zsol",
                                                          "terrainheight",
                                                          "terrain",
                                                          "hmaaiveld",
                                                          "b3hmaaiveld",
                                                          "baseelevation",
                                                          "basez",
                                                          "zbase",
                                                          "zmin",
                                                          "ele",
                                                          "elevation",
                                                          "altitudeminimalesol"});
// Altitudes of the ground at a building's uphill side, where the names above give those of its downhill side.
constexpr auto kUphill = std::to_array<std::string_view>({"zmaxsol", "altitudemaximalesol"});
// Altitudes of roofs, eaves before ridges.
constexpr auto kRoof = std::to_array<std::string_view>(
    {"zmintoit", "altitudeminimaletoit", "zmaxtoit", "altitudemaximaletoit", "ztoit", "zroof", "roofz", "roofaltitude",
     "roofelevation", "b3hdak50p", "b3hdakmax", "absoluteeavesheight", "absoluteridgeheight"});

bool separator(char c) {
  return c == '_' || c == '-' || c == ':' || c == '.' || c == ' ';
}

}  // namespace

std::span<const std::string_view> heightNames() {
  return kHeight;
}
std::span<const std::string_view> storeyNames() {
  return kStoreys;
}
std::span<const std::string_view> groundNames() {
  return kGround;
}

std::span<const std::string_view> uphillNames() {
  return kUphill;
}
std::span<const std::string_view> roofNames() {
  return kRoof;
}

std::string plainName(std::string_view column) {
  std::string out;
  for (const char c : column)
    if (!separator(c)) out.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  return out;
}

std::vector<size_t> columnsNamed(std::span<const std::string> columns, std::span<const std::string_view> names) {
  std::vector<std::string> plain;
  for (const std::string& c : columns) plain.push_back(plainName(c));
  std::vector<size_t> out;
  for (const std::string_view name : names)
    for (size_t i = 0; i < plain.size(); ++i)
      if (plain[i] == name) out.push_back(i);
  return out;
}

double numberIn(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    const bool sign = text[i] == '-' && i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9';
    if (!digit && !sign) continue;
    std::string number;
    for (size_t k = i; k < text.size(); ++k) {
      const char c = text[k] == ',' ? '.' : text[k];
      if ((c < '0' || c > '9') && c != '.' && c != 'e' && c != 'E' && c != '-' && c != '+') break;
      number.push_back(c);
    }
    const double value = std::strtod(number.c_str(), nullptr);
    return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace vicus::assets
