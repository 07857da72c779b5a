#include "assets/import/citygml_kinds.hpp"

namespace vicus::assets::citygml_kinds {

SurfaceKind kindOf(Type type) {
  switch (type) {
    case Type::COT_WallSurface:
      return SurfaceKind::Wall;
    case Type::COT_RoofSurface:
      return SurfaceKind::Roof;
    case Type::COT_GroundSurface:
      return SurfaceKind::Ground;
    case Type::COT_Window:
      return SurfaceKind::Window;
    case Type::COT_Door:
      return SurfaceKind::Door;
    case Type::COT_ClosureSurface:
    case Type::COT_OuterCeilingSurface:
    case Type::COT_OuterFloorSurface:
    case Type::COT_FloorSurface:
    case Type::COT_CeilingSurface:
    case Type::COT_InteriorWallSurface:
      return SurfaceKind::Other;
    default:
      return SurfaceKind::Unknown;
  }
}

SurfaceKind kindOf(citygml::Geometry::GeometryType type) {
  using Kind = citygml::Geometry::GeometryType;
  switch (type) {
    case Kind::GT_Roof:
      return SurfaceKind::Roof;
    case Kind::GT_Wall:
      return SurfaceKind::Wall;
    case Kind::GT_Ground:
      return SurfaceKind::Ground;
    default:
      return SurfaceKind::Unknown;
  }
}

Role roleOf(Type type) {
  switch (type) {
    case Type::COT_Building:
    case Type::COT_BuildingPart:
    case Type::COT_BuildingInstallation:
    case Type::COT_Bridge:
    case Type::COT_BridgePart:
    case Type::COT_BridgeConstructionElement:
    case Type::COT_BridgeInstallation:
    case Type::COT_Tunnel:
    case Type::COT_GenericCityObject:
      return Role::Building;
    case Type::COT_ReliefFeature:
    case Type::COT_ReliefComponent:
    case Type::COT_TINRelief:
      return Role::Terrain;
    case Type::COT_WaterBody:
      return Role::Water;
    case Type::COT_Road:
    case Type::COT_Track:
    case Type::COT_Railway:
    case Type::COT_Square:
    case Type::COT_TransportationObject:
    case Type::COT_PlantCover:
    case Type::COT_LandUse:
      return Role::Cover;
    case Type::COT_SolitaryVegetationObject:
      return Role::Tree;
    case Type::COT_Room:
    case Type::COT_BuildingFurniture:
    case Type::COT_IntBuildingInstallation:
    case Type::COT_InteriorWallSurface:
      return Role::Inside;
    default:
      return Role::LeftOut;
  }
}

city::Ground coverOf(Type type) {
  if (type == Type::COT_PlantCover) return city::Ground::Garden;
  if (type == Type::COT_LandUse) return city::Ground::Grass;
  if (type == Type::COT_Square) return city::Ground::Paving;
  return type == Type::COT_Railway ? city::Ground::Earth : city::Ground::Street;
}

}  // namespace vicus::assets::citygml_kinds
