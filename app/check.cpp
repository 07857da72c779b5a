#include <algorithm>
#include <ostream>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/open_scene.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/item_buffers.hpp"
#include "viewer/pictures.hpp"
#include "viewer/tours.hpp"

namespace vicus::app {

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
  scenegraph::Scene graph(scene->city, scene->knobs, diagnostics,
                          [&](std::string_view stage, double fraction) { console.progress(stage, fraction); });
  console.progressDone();
  console.report(diagnostics);
  viewer::Renderer renderer(*context, graph, static_cast<int>(scene->knobs["viewer.multisamples"]));

  finishCache(*scene, console);

  // One planner as asked and one with every technique off, each with what it remembers between views.
  const plan::Planner planner(scene->city, scene->knobs);
  const plan::Planner everything(scene->city, withoutTechniques(scene->knobs));
  plan::PlannerState state, everythingState;
  const double fov = glm::radians(scene->knobs["viewer.fov"]);
  city::Random random(options.seed);

  size_t done = 0, badViews = 0;
  uint64_t lost = 0, differing = 0, shown = 0, pixels = 0, differingColours = 0, culled = 0;
  int largest = 0;
  for (; done < options.views && !interrupted(); ++done) {
    const city::ViewPose pose = viewer::randomView(scene->city, random);
    const city::ViewState view = city::makeView(pose, fov, options.size);
    const city::FramePlan plan = planner.plan(scene->city, view, 0, state);
    const city::FramePlan full = everything.plan(scene->city, view, 0, everythingState);

    const viewer::ItemBuffer fullItems = renderer.drawItems(full);
    const viewer::ItemCheck items = viewer::checkItems(scene->city, plan, fullItems, renderer.drawItems(plan));
    renderer.draw(full);
    const viewer::Picture fullPicture = renderer.readPicture();
    renderer.draw(plan);
    const viewer::PictureDifference colours = viewer::compare(fullPicture, renderer.readPicture());

    lost += items.lostPixels, differing += items.differingPixels, shown += items.shownPixels;
    pixels += fullItems.ids.size();
    culled += full.counts.instancesDrawn - plan.counts.instancesDrawn;
    differingColours += colours.differingPixels, largest = std::max(largest, colours.largest);
    if (items.differingPixels > 0 || colours.differingPixels > 0) {
      ++badViews;
      console.warn("view " + std::to_string(done) + ": " + std::to_string(items.lostPixels) + " pixels lost, " +
                   std::to_string(items.differingPixels) + " items and " + std::to_string(colours.differingPixels) +
                   " colours differ; --view " + std::to_string(pose.eye.x) + "," + std::to_string(pose.eye.y) + "," +
                   std::to_string(pose.eye.z) + "," + std::to_string(glm::degrees(pose.heading)) + "," +
                   std::to_string(glm::degrees(pose.pitch)));
    }
    console.progress("checking", static_cast<double>(done + 1) / static_cast<double>(options.views));
  }
  console.progressDone();
  for (const std::string& problem : renderer.problems()) console.error(problem), code = kCouldNot;

  const auto line = [&](const std::string& label, uint64_t value, const std::string& of) {
    surroundings.out << label << ": " << value << of << "\n";
  };
  line("views", done, " at " + std::to_string(options.size.x) + "x" + std::to_string(options.size.y));
  line("instances culled", culled,
       " of " + std::to_string(done * (scene->city.buildings.size() + scene->city.monuments.size())));
  line("pixels lost", lost, " of " + std::to_string(shown) + " that show a building or monument");
  line("pixels whose item differs", differing, " of " + std::to_string(pixels));
  line("pixels whose colour differs", differingColours, ", by " + std::to_string(largest) + "/255 at most");
  line("views that differ", badViews, "");
  surroundings.out << std::flush;
  if (lost > 0) code = kCouldNot;
  return code;
}

}  // namespace vicus::app
