/// Runs the algorithms in order for one view and fills the FramePlan.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "city/knob.hpp"
#include "culling/cull_map.hpp"
#include "houselod/house_types.hpp"
#include "plan/people.hpp"
#include "plan/shadows.hpp"
#include "terrain/roam.hpp"

namespace vicus::plan {

/// A feature of the program and whether this scene has it.
struct FeatureReport {
  std::string name;        ///< "frustum_culling", "terrain", "trees", …
  bool technique = false;  ///< trades error for time; false: content
  bool on = false;
  std::string why;  ///< for people: "no height field", "388 tiles"
};

/// What must be remembered between frames of one view; one for each view (eye, reference, item buffer, frozen view).
struct PlannerState {
  size_t runs = 0;     ///< runs of buildings in the last plan: how much room to make for the next; changes no result
  PeopleState people;  ///< their poses
  ShadowState shadows;
  std::optional<terrain::Roam> ground;  ///< the mesh of this view; refers to the city and to the planner
};

/// Knobs of the planning techniques (frustum_culling, roam, …).
std::span<const city::Knob> planKnobs();

/// The one composition: looks at the scene and the knobs once and makes only the steps that this scene needs.
/// Invariant: `plan` changes nothing but the state it is given; the same arguments give the same plan.
class Planner {
 public:
  Planner(const city::City& city, const city::Knobs& knobs);
  ~Planner();
  Planner(Planner&&) noexcept;
  Planner& operator=(Planner&&) noexcept;

  /// `city` is the one that the planner was made for; it, and the planner, must outlive the state. `dt` in seconds
  /// since this view's last plan.
  city::FramePlan plan(const city::City& city, const city::ViewState& view, double dt, PlannerState& state) const;

  /// What the cull map holds for a view, for people to look at; nothing where this scene has none.
  culling::CullMapView cullMap(const city::City& city, const city::ViewState& view) const;

  /// Every technique and kind of content, on or off, with the reason.
  const std::vector<FeatureReport>& features() const;
  /// What house LOD knows of the building types, for drawing by the plans; null where it is off.
  std::shared_ptr<const houselod::HouseTypes> houses() const;
  /// Names of the steps in the order run.
  std::vector<std::string> steps() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::plan
