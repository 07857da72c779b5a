#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/open_scene.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/item_buffers.hpp"
#include "viewer/pictures.hpp"
#include "viewer/tours.hpp"

namespace vicus::app {
namespace {

/// What was found, added up over views.
struct Tally {
  uint64_t lost = 0, differing = 0, shown = 0, pixels = 0, differingColours = 0, culled = 0;
  uint64_t drawn = 0, visible = 0;  ///< buildings and monuments planned, and those with a pixel
  size_t badViews = 0, pictures = 0;
  int largest = 0;
};

/// The view as `--view` takes it, to the micrometre.
std::string asOption(const city::ViewPose& pose) {
  std::ostringstream text;
  text << std::setprecision(17) << "--view " << pose.eye.x << "," << pose.eye.y << "," << pose.eye.z << ","
       << glm::degrees(pose.heading) << "," << glm::degrees(pose.pitch);
  return text.str();
}

/// "building 17 at 120,33": what was lost first, and in which pixel.
std::string lostIn(const viewer::ItemCheck& items, const city::City& city, const viewer::ItemBuffer& full) {
  if (items.lostAt.empty()) return {};
  const glm::ivec2 at = items.lostAt.front();
  const uint32_t index =
      full.ids[static_cast<size_t>(at.y) * static_cast<size_t>(full.width) + static_cast<size_t>(at.x)] - 1;
  const auto buildings = static_cast<uint32_t>(city.buildings.size());
  const uint32_t things = city.itemCount() - 1;
  return (index < buildings ? " (building " + std::to_string(index)
          : index < things  ? " (monument " + std::to_string(index - buildings)
                            : " (person " + std::to_string(index - things)) +
         " at " + std::to_string(at.x) + "," + std::to_string(at.y) + ")";
}

/// Buildings and monuments that have a pixel.
size_t itemsIn(const viewer::ItemBuffer& buffer, const city::City& city) {
  std::vector<uint32_t> ids = buffer.ids;
  std::sort(ids.begin(), ids.end());
  const auto end = std::unique(ids.begin(), ids.end());
  return static_cast<size_t>(
      std::count_if(ids.begin(), end, [&](uint32_t id) { return id != 0 && id < city.itemCount(); }));
}

}  // namespace

int check(const CheckOptions& options, const Surroundings& surroundings) {
  Console console(surroundings);
  int code = kDone;
  std::optional<OpenScene> scene = openScene(options.scene, surroundings, console, code);
  if (!scene) return code;
  std::string error;
  const std::unique_ptr<viewer::GlContext> context = viewer::makeOffscreenContext(error);
  if (!context) {
    console.error(error);
    return kCouldNot;
  }
  city::Diagnostics diagnostics;
  scenegraph::Scene graph(*scene->city, scene->knobs, diagnostics,
                          [&](std::string_view stage, double fraction) { console.progress(stage, fraction); });
  console.progressDone();
  console.report(diagnostics);
  viewer::Renderer renderer(*context, graph, static_cast<int>(scene->knobs["viewer.multisamples"]));

  finishCache(*scene, console);

  // One planner as asked and one with every technique off, each with what it remembers between views. What hides what
  // is checked on one ground and with one set of bodies and houses: those at full detail.
  city::Knobs onFullGround = scene->knobs;
  onFullGround.set("roam", 0);
  onFullGround.set("avatar_lod", 0);
  onFullGround.set("house_lod", 0);
  const plan::Planner planner(*scene->city, onFullGround);
  const plan::Planner everything(*scene->city, withoutTechniques(scene->knobs));
  plan::PlannerState state, everythingState;
  city::Random random(options.seed);
  const size_t views = options.single.empty() ? options.views : options.single.size();
  const auto poseOf = [&](size_t k) -> city::ViewPose {
    if (!options.single.empty()) {
      const ViewOption& single = options.single[k];
      return {single.eye, single.heading, single.pitch, 0};
    }
    return options.street ? viewer::randomStreetView(*scene->city, random) : viewer::randomView(*scene->city, random);
  };

  Tally tally;
  size_t done = 0;
  for (; done < views && !interrupted(); ++done) {
    const city::ViewPose pose = poseOf(done);
    const double knob = glm::radians(scene->knobs["viewer.fov"]);
    const double fov = options.single.empty() ? knob : options.single[done].fov.value_or(knob);
    const city::ViewState view = city::makeView(pose, fov, options.size);
    const city::FramePlan plan = planner.plan(*scene->city, view, 0, state);
    const city::FramePlan full = everything.plan(*scene->city, view, 0, everythingState);

    const viewer::ItemBuffer fullItems = renderer.drawItems(full);
    const viewer::ItemCheck items = viewer::checkItems(*scene->city, plan, fullItems, renderer.drawItems(plan));
    viewer::PictureDifference colours;
    if (options.picturesEvery > 0 && done % options.picturesEvery == 0) {
      renderer.draw(full);
      const viewer::Picture fullPicture = renderer.readPicture();
      renderer.draw(plan);
      colours = viewer::compare(fullPicture, renderer.readPicture());
      ++tally.pictures;
    }

    tally.lost += items.lostPixels, tally.differing += items.differingPixels, tally.shown += items.shownPixels;
    tally.pixels += fullItems.ids.size();
    tally.culled += full.counts.instancesDrawn - plan.counts.instancesDrawn;
    tally.drawn += plan.counts.instancesDrawn, tally.visible += itemsIn(fullItems, *scene->city);
    tally.differingColours += colours.differingPixels, tally.largest = std::max(tally.largest, colours.largest);
    if (items.differingPixels > 0 || colours.differingPixels > 0) {
      ++tally.badViews;
      console.warn("view " + std::to_string(done) + ": " + std::to_string(items.lostPixels) + " pixels lost" +
                   lostIn(items, *scene->city, fullItems) + ", " + std::to_string(items.differingPixels) +
                   " items and " + std::to_string(colours.differingPixels) + " colours differ; " + asOption(pose));
    }
    console.progress("checking", static_cast<double>(done + 1) / static_cast<double>(views));
  }
  console.progressDone();
  for (const std::string& problem : renderer.problems()) console.error(problem), code = kCouldNot;

  const auto line = [&](const std::string& label, uint64_t value, const std::string& of) {
    surroundings.out << label << ": " << value << of << "\n";
  };
  line("views", done, " at " + std::to_string(options.size.x) + "x" + std::to_string(options.size.y));
  line("instances culled", tally.culled,
       " of " + std::to_string(done * (scene->city->buildings.size() + scene->city->monuments.size())));
  line("instances drawn", tally.drawn, "; " + std::to_string(tally.visible) + " of them have a pixel at this size");
  line("pixels lost", tally.lost, " of " + std::to_string(tally.shown) + " that show a building, monument or person");
  line("pixels whose item differs", tally.differing, " of " + std::to_string(tally.pixels));
  line("pixels whose colour differs", tally.differingColours,
       " in " + std::to_string(tally.pictures) + " pictures, by " + std::to_string(tally.largest) + "/255 at most");
  line("views that differ", tally.badViews, "");
  surroundings.out << std::flush;
  if (tally.lost > 0) code = kCouldNot;
  return code;
}

}  // namespace vicus::app
