/// What the objects of CityJSON are, and what their attributes say.
#pragma once

#include <cmath>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "assets/import/cityjson_geometry.hpp"
#include "assets/import/source.hpp"
#include "city/city.hpp"

namespace vicus::assets::cityjson {

/// What of an object is in the city.
enum class Role { Building, Part, Terrain, Water, Cover, Tree, LeftOut, Unknown };

/// Of an object's type; Unknown for those of extensions.
Role roleOf(const std::string& type);
/// What a road, a square or a wood covers the ground with, by the object's type.
city::Ground coverOf(const std::string& type);

/// Appends the scalars of nested attributes: "roof.type.value". `name` is that of the value, empty at the top.
void flatten(const Json& value, const std::string& name, int depth, city::Attributes& out);
/// First number over `above` among attributes with one of the usual names; an object's "value" counts as the attribute.
double firstNumberNamed(const city::Attributes& attributes, std::span<const std::string_view> names,
                        double above = -INFINITY);
/// Height in metres: of the attribute `column` where it is not empty, else by its usual names, else by storeys.
double heightIn(const city::Attributes& attributes, const std::string& column);

/// Adds the content of one feature of a sequence to that of those before it.
void append(Source& whole, Source&& part);

}  // namespace vicus::assets::cityjson
