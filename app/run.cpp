#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>

#include "app/commands.hpp"

namespace vicus::app {
namespace {

/// What the arguments were told to be, before anything is checked against anything else.
struct Parsed {
  WalkOptions walk;
  InfoOptions info;
  CheckOptions check;
  ReportCommandOptions report;
  WalkOptions film;
  ImportOptions draft;
  bool knobsJson = false;
  std::string shift[6];  ///< of walk, info, check, report, film and import
  std::string walkSize, checkSize, filmSize;
  std::vector<std::string> views, checkViews;
  std::string seenFrom;
};

void addScene(CLI::App& command, SceneOptions& scene, std::string& shift) {
  command.add_option("SCENE", scene.inputs,
                     "norvic (the default), norvic:8000, norwich-2001, a scene description (*.toml), or files as they "
                     "come: footprints, CityJSON, CityGML, OpenStreetMap, 3D Tiles, elevation, meshes");
  // Options that may be repeated take one value each, so that they never swallow the scene.
  const auto repeated = [&](const char* name, std::vector<std::string>& values, const char* help) {
    return command.add_option(name, values, help)->allow_extra_args(false);
  };
  repeated("--dem", scene.elevation, "elevation raster for the terrain")->type_name("FILE");
  command.add_option("--height-column", scene.heightColumn, "column of building heights in metres")->type_name("NAME");
  command.add_option("--ground-column", scene.groundColumn, "column of the ground's altitude in metres")
      ->type_name("NAME");
  command.add_option("--crs", scene.crs, "coordinates of files that name none, as EPSG:2154")->type_name("CRS");
  command
      .add_option("--dem-unit", scene.terrainUnit, "unit of the elevation's heights, where the file does not say it")
      ->check(CLI::IsMember({"m", "dm", "cm", "ft", "us-ft"}))
      ->type_name("UNIT");
  command.add_option("--lod", scene.lod, "finest level of detail that is wanted of CityJSON and CityGML, 0 to 3")
      ->check(CLI::NonNegativeNumber)
      ->type_name("L");
  command.add_option("--shift", shift, "metres added to all coordinates: x,y,z")->type_name("X,Y,Z");
  command.add_flag("--no-cache", scene.noCache, "neither read nor write the cache");
  repeated("--set", scene.knobs, "set a knob (see vicus knobs)")->type_name("KNOB=VALUE");
}

void addWalk(CLI::App& app, Parsed& p) {
  CLI::App& walk = *app.add_subcommand("walk", "walk in a window, or draw pictures offscreen with --headless");
  addScene(walk, p.walk.scene, p.shift[0]);
  walk.add_flag("--headless", p.walk.headless, "draw offscreen; needs no display");
  CLI::Option* path = walk.add_option("--path", p.walk.path, "follow the keys in a JSON file")->type_name("FILE");
  CLI::Option* tour =
      walk.add_option("--tour", p.walk.tour, "follow a tour: street, flyover, turn, teleport, or one of the scene's")
          ->type_name("NAME");
  CLI::Option* view = walk.add_option("--view", p.views,
                                      "draw a single view: metres from the city's origin and degrees, heading "
                                      "counter-clockwise from east; may be repeated")
                          ->allow_extra_args(false)
                          ->type_name("X,Y,Z,HEADING,PITCH[,FOV]");
  CLI::Option* frames =
      walk.add_option("--frames", p.walk.frames, "frames spread evenly over the tour, after 10 to warm up")
          ->check(CLI::PositiveNumber)
          ->type_name("N");
  CLI::Option* fps = walk.add_option("--fps", p.walk.fps,
                                     "play the tour in real time at so many frames a second; with --headless every "
                                     "frame of that film")
                         ->check(CLI::PositiveNumber)
                         ->type_name("F");
  path->excludes(tour)->excludes(view);
  tour->excludes(view);
  frames->excludes(fps)->excludes(view);
  fps->excludes(view);
  walk.add_option("--size", p.walkSize, "of the picture or window, 1280x720 by default")->type_name("WxH");
  walk.add_option("--out", p.walk.out, "folder for pictures (PNG)")->type_name("DIR");
  walk.add_option("--every", p.walk.every, "write every K-th frame only")->check(CLI::PositiveNumber)->type_name("K");
  walk.add_option("--json", p.walk.json, "write the figures of the run")->type_name("FILE");
  walk.add_flag("--overlay", p.walk.overlay, "show frame times, counts, errors and knobs over the picture (F2)");
  walk.add_option("--seen-from", p.seenFrom,
                  "freeze each frame's plan (F3) and show from there what it leaves out and why")
      ->type_name("X,Y,Z,HEADING,PITCH[,FOV]");
  walk.add_option("--trace", p.walk.trace, "write the stages of every frame for chrome://tracing or Perfetto")
      ->type_name("FILE");
}

void addFilm(CLI::App& app, Parsed& p) {
  CLI::App& film = *app.add_subcommand("film", "renders a tour to a video file or to pictures, frame by frame");
  addScene(film, p.film.scene, p.shift[4]);
  CLI::Option* path = film.add_option("--path", p.film.path, "follow the keys in a JSON file")->type_name("FILE");
  film.add_option("--tour", p.film.tour, "the tour: street (the default), flyover, turn, teleport, or the scene's")
      ->type_name("NAME")
      ->excludes(path);
  film.add_option("-o,--out", p.film.film, "video file (.mp4, .mkv, .mov, .webm), or a folder for pictures (PNG)")
      ->required()
      ->type_name("FILE");
  film.add_option("--fps", p.film.fps, "frames a second, 30 by default")->check(CLI::Range(1.0, 240.0))->type_name("F");
  film.add_option("--size", p.filmSize, "of the picture, 1280x720 by default")->type_name("WxH");
}

void addOthers(CLI::App& app, Parsed& p) {
  CLI::App& info = *app.add_subcommand("info", "what a scene holds, which features are on or off and why");
  addScene(info, p.info.scene, p.shift[1]);
  CLI::Option* json = info.add_flag("--json", p.info.json, "as JSON");
  info.add_flag("--graph", p.info.graph, "the scene graph instead, node by node")->excludes(json);

  CLI::App& knobs = *app.add_subcommand("knobs", "every knob: default, unit, what too small and too large do");
  knobs.add_flag("--json", p.knobsJson, "as JSON");

  CLI::App& report = *app.add_subcommand("report", "error against run time: every technique measured, as a web page");
  addScene(report, p.report.scene, p.shift[3]);
  report.add_option("-o,--out", p.report.out, "folder for report.html, report.json and report.csv")
      ->required()
      ->type_name("DIR");
  report.add_flag("--quick", p.report.quick, "small pictures and few frames: about a minute for a town");

  CLI::App& draft = *app.add_subcommand("import", "writes a first scene description for files, with comments");
  addScene(draft, p.draft.scene, p.shift[5]);
  draft.add_option("-o,--out", p.draft.out, "the description, SCENE.toml")->required()->type_name("FILE");
  draft.add_flag("--overwrite", p.draft.overwrite, "replace the file where it exists");

  CLI::App& check = *app.add_subcommand(
      "check", "compares random views with and without the techniques: no pixel of a building may be lost");
  addScene(check, p.check.scene, p.shift[2]);
  check.add_option("--views", p.check.views, "how many views, 100 by default")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  check.add_option("--seed", p.check.seed, "another seed gives other views")->type_name("S");
  check.add_option("--size", p.checkSize, "of the pictures, 320x180 by default")->type_name("WxH");
  check.add_flag("--street", p.check.street, "at eye level only, none from the air");
  check
      .add_option("--pictures", p.check.picturesEvery,
                  "compare pictures too in each K-th view, 1 by default; 0: item buffers alone")
      ->type_name("K");
  check.add_option("--view", p.checkViews, "this view instead of random ones, as for walk; may be repeated")
      ->allow_extra_args(false)
      ->type_name("X,Y,Z,HEADING,PITCH[,FOV]");
}

/// Completes the options from their texts; what is wrong, or an empty text.
std::string complete(Parsed& p) {
  SceneOptions* scenes[] = {&p.walk.scene,   &p.info.scene, &p.check.scene,
                            &p.report.scene, &p.film.scene, &p.draft.scene};
  for (size_t k = 0; k < std::size(scenes); ++k) {
    if (scenes[k]->inputs.empty()) scenes[k]->inputs = {"norvic"};
    if (p.shift[k].empty()) continue;
    const auto numbers = parseNumbers(p.shift[k], 3, 3);
    if (!numbers) return "--shift takes three numbers x,y,z, not '" + p.shift[k] + "'";
    scenes[k]->shift = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  }
  const std::pair<const std::string*, glm::ivec2*> sizes[] = {
      {&p.walkSize, &p.walk.size}, {&p.checkSize, &p.check.size}, {&p.filmSize, &p.film.size}};
  for (const auto& [text, size] : sizes) {
    if (text->empty()) continue;
    const auto parsed = parseSize(*text);
    if (!parsed) return "--size takes WIDTHxHEIGHT, each 1 to 16384, not '" + *text + "'";
    *size = *parsed;
  }
  if (!p.seenFrom.empty()) {
    std::string error;
    p.walk.seenFrom = parseView(p.seenFrom, error);
    if (!p.walk.seenFrom) return "--seen-from: " + error;
  }
  const std::pair<const std::vector<std::string>*, std::vector<ViewOption>*> views[] = {
      {&p.views, &p.walk.views}, {&p.checkViews, &p.check.single}};
  for (const auto& [texts, parsed] : views)
    for (const std::string& text : *texts) {
      std::string error;
      const auto view = parseView(text, error);
      if (!view) return error;
      parsed->push_back(*view);
    }
  return {};
}

}  // namespace

int run(std::span<const std::string> arguments, const Surroundings& surroundings) {
  Parsed parsed;
  CLI::App app("Vicus: walk and fly through large historic cities in real time.", "vicus");
  app.require_subcommand(1);
  addWalk(app, parsed);
  addOthers(app, parsed);
  addFilm(app, parsed);

  // CLI11 would only say that a command is missing.
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  const auto named = [&](const CLI::App* command) { return command->get_name() == arguments.front(); };
  if (!arguments.empty() && !arguments.front().starts_with('-') &&
      std::none_of(commands.begin(), commands.end(), named)) {
    surroundings.err << "error: there is no command '" << arguments.front() << "'; there are";
    for (const CLI::App* command : commands) surroundings.err << " " << command->get_name();
    surroundings.err << "\n";
    return kWrongUsage;
  }

  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    app.parse(reversed);
  } catch (const CLI::ParseError& e) {
    // Help is a result; anything else is the user's to mend.
    const bool help = e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    app.exit(e, surroundings.out, surroundings.err);
    return help ? kDone : kWrongUsage;
  }
  if (const std::string problem = complete(parsed); !problem.empty()) {
    surroundings.err << "error: " << problem << "\n";
    return kWrongUsage;
  }

  if (app.got_subcommand("walk")) return walk(parsed.walk, surroundings);
  if (app.got_subcommand("film")) return film(parsed.film, surroundings);
  if (app.got_subcommand("info")) return info(parsed.info, surroundings);
  if (app.got_subcommand("import")) return importScene(parsed.draft, surroundings);
  if (app.got_subcommand("report")) return report(parsed.report, surroundings);
  if (app.got_subcommand("check")) return check(parsed.check, surroundings);
  return knobs(parsed.knobsJson, surroundings);
}

}  // namespace vicus::app
