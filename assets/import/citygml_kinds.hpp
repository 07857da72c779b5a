/// What libcitygml's types of objects and geometries are in a city.
#pragma once

#include <citygml/cityobject.h>
#include <citygml/geometry.h>

#include "assets/import/source.hpp"

namespace vicus::assets::citygml_kinds {

using Type = citygml::CityObject::CityObjectsType;

enum class Role { Building, Terrain, Water, Cover, Tree, Inside, LeftOut };

Role roleOf(Type type);
SurfaceKind kindOf(Type type);
SurfaceKind kindOf(citygml::Geometry::GeometryType type);
/// What an object of Role::Cover covers the ground with.
city::Ground coverOf(Type type);

}  // namespace vicus::assets::citygml_kinds
