#include "assets/load_city.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <charconv>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <sstream>

#include "assets/cache/blob_cache.hpp"
#include "assets/cache/builder_version.hpp"
#include "assets/cache/city_codec.hpp"
#include "assets/cache/hash.hpp"
#include "assets/import/gdal_messages.hpp"
#include "assets/import/import_city.hpp"
#include "assets/import/parallel.hpp"
#include "assets/import/projection.hpp"
#include "assets/import/read_file.hpp"
#include "assets/norvic/norvic.hpp"
#include "assets/scene/apply_scene.hpp"
#include "assets/styles/styles.hpp"

namespace vicus::assets {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kMostHouses = 1'000'000;

bool isBuiltIn(const std::string& input) {
  return input == "norvic" || input.starts_with("norvic:") || input == "norwich-2001";
}

LoadResult loadBuiltIn(const std::string& input, const LoadOptions& options) {
  LoadResult result;
  if (input == "norwich-2001") {
    result.city = generateNorwich2001(1, options.progress);
  } else {
    NorvicOptions norvic;
    if (const size_t colon = input.find(':'); colon != std::string::npos) {
      const char* begin = input.data() + colon + 1;
      const char* end = input.data() + input.size();
      const auto [last, error] = std::from_chars(begin, end, norvic.houses);
      if (error != std::errc() || last != end || norvic.houses < 1 || norvic.houses > kMostHouses) {
        result.diagnostics.error(input, "", "the number of houses is a whole number from 1 to 1000000");
        return result;
      }
    }
    result.city = generateNorvic(norvic, options.progress);
  }
  result.city->origin += options.shift;
  return result;
}

bool isDescription(const std::string& file) {
  return file.ends_with(".toml") || file.ends_with(".TOML");
}

/// Where a file of a scene lies: relative to the description's folder, else to the folder of data; as written where it
/// is in neither, so that the message about it names what was written.
std::string resolve(const SceneDescription& scene, const LoadOptions& options, const std::string& file) {
  if (scene.file.empty() || fs::path(file).is_absolute()) return file;
  std::error_code error;
  const fs::path beside = fs::path(scene.folder) / file;
  if (fs::exists(beside, error)) return beside.string();
  const fs::path elsewhere = fs::path(options.dataFolder) / file;
  if (!options.dataFolder.empty() && fs::exists(elsewhere, error)) return elsewhere.string();
  return beside.string();
}

/// Where a file of rules lies: beside the description, else where other files of the scene do.
std::string resolveRules(const SceneDescription& scene, const LoadOptions& options, const std::string& rules) {
  if (!rules.ends_with(".rules") || scene.file.empty() || fs::path(rules).is_absolute()) return rules;
  std::error_code error;
  const fs::path beside = fs::path(scene.file).parent_path() / rules;
  return fs::exists(beside, error) ? beside.lexically_normal().string() : resolve(scene, options, rules);
}

/// All style rules of a scene, those of its sources first.
std::vector<StyleRule*> styleRulesOf(SceneDescription& scene) {
  std::vector<StyleRule*> all;
  for (SceneSource& s : scene.sources)
    for (StyleRule& rule : s.styles) all.push_back(&rule);
  for (StyleRule& rule : scene.styles) all.push_back(&rule);
  return all;
}

/// The user's own files of rules that a scene names, each once.
std::vector<std::string> ownRulesOf(const SceneDescription& scene) {
  std::set<std::string> files;
  const auto add = [&](const std::vector<StyleRule>& rules) {
    for (const StyleRule& rule : rules)
      if (rule.rules.ends_with(".rules")) files.insert(rule.rules);
  };
  add(scene.styles);
  for (const SceneSource& s : scene.sources) add(s.styles);
  return {files.begin(), files.end()};
}

/// Whether the rules have the parameters that the scene sets. Rules that cannot be read have their say later.
bool checkParameters(SceneDescription& scene, city::Diagnostics& diagnostics) {
  bool good = true;
  for (const StyleRule* rule : styleRulesOf(scene)) {
    if (rule->parameters.empty()) continue;
    city::Diagnostics unheard;
    const std::optional<facade::Style> style = loadStyle(rule->rules, unheard);
    if (!style) continue;
    for (const StyleParameter& p : rule->parameters)
      if (const std::string problem = parameterProblem(*style, p.name, p.value); !problem.empty())
        diagnostics.error(scene.file, p.place, problem), good = false;
  }
  return good;
}

/// What the command line names, as a scene description would.
SceneDescription sceneOfArguments(std::span<const std::string> inputs) {
  SceneDescription scene;
  scene.name = inputs.empty() ? "" : fs::path(inputs[0]).stem().string();
  for (const std::string& input : inputs) scene.sources.emplace_back().file = input;
  return scene;
}

/// The description that the user names, or one made from the files that she names, its paths resolved. Nothing, with
/// errors, where it cannot be read.
std::optional<SceneDescription> sceneOf(std::span<const std::string> inputs, const LoadOptions& options,
                                        city::Diagnostics& diagnostics) {
  std::optional<SceneDescription> scene;
  const auto description = std::find_if(inputs.begin(), inputs.end(), isDescription);
  if (description == inputs.end()) {
    scene = sceneOfArguments(inputs);
  } else if (inputs.size() > 1) {
    diagnostics.error(*description, "", "a scene description stands alone: name the other files in it");
  } else {
    std::ifstream stream(*description, std::ios::binary);
    std::ostringstream text;
    if (stream) text << stream.rdbuf();
    if (!stream)
      diagnostics.error(*description, "", "cannot be read");
    else
      scene = parseScene(std::move(text).str(), *description, diagnostics);
  }
  if (!scene) return std::nullopt;
  for (StyleRule* rule : styleRulesOf(*scene)) rule->rules = resolveRules(*scene, options, rule->rules);
  if (!checkParameters(*scene, diagnostics)) return std::nullopt;
  for (SceneSource& s : scene->sources) {
    s.file = resolve(*scene, options, s.file);
    // The command line's wishes hold for all sources that have none of their own.
    if (s.heightColumn.empty()) s.heightColumn = options.heightColumn;
    if (s.groundColumn.empty()) s.groundColumn = options.groundColumn;
    s.lod = std::min(s.lod, options.lod);
    s.styles.insert(s.styles.end(), scene->styles.begin(), scene->styles.end());
  }
  for (std::string& file : scene->terrain.files) file = resolve(*scene, options, file);
  for (SceneMonument& m : scene->monuments) m.file = resolve(*scene, options, m.file);
  for (std::vector<std::string>* files : {&scene->avatars.characters, &scene->avatars.motions})
    for (std::string& file : *files) file = resolve(*scene, options, file);
  if (!options.terrainUnit.empty()) scene->terrain.unit = options.terrainUnit;
  scene->terrain.files.insert(scene->terrain.files.end(), options.elevation.begin(), options.elevation.end());
  return scene;
}

LoadResult loadScene(const SceneDescription& scene, const LoadOptions& options) {
  LoadResult result;
  GdalMessages messages;
  const std::string named = scene.crs.empty() ? "" : crsFromText(scene.crs);
  if (!scene.crs.empty() && named.empty())
    result.diagnostics.error(scene.file, "crs", "the CRS " + scene.crs + " is not known");
  std::string fallback = named;
  if (!options.crs.empty()) {
    fallback = crsFromText(options.crs);
    if (fallback.empty()) result.diagnostics.error("--crs", "", "the CRS " + options.crs + " is not known");
  }

  // Every file in its own thread; what they say in their order.
  const size_t sources = scene.sources.size(), rasters = scene.terrain.files.size(),
               all = sources + rasters + scene.monuments.size();
  std::vector<FileContent> contents(all);
  std::atomic<size_t> done = 0;
  std::mutex progressMutex;
  parallelFor(all, 1, [&](size_t i) {
    const GdalMessages quiet;
    const std::string& file = i < sources             ? scene.sources[i].file
                              : i < sources + rasters ? scene.terrain.files[i - sources]
                                                      : scene.monuments[i - sources - rasters].file;
    if (options.progress) {
      const std::scoped_lock lock(progressMutex);
      options.progress("reading " + fs::path(file).filename().string(),
                       static_cast<double>(done) / static_cast<double>(all));
    }
    if (i < sources)
      contents[i] = readFile(scene.sources[i], fallback, scene.terrain.unit);
    else if (i < sources + rasters)
      contents[i] = readElevationFile(file, scene.terrain, fallback);
    else
      contents[i] = readMonument(scene.monuments[i - sources - rasters], file, named);
    ++done;
  });
  std::vector<Source> found;
  std::vector<ElevationRaster> elevation;
  for (FileContent& c : contents) {
    std::move(c.sources.begin(), c.sources.end(), std::back_inserter(found));
    elevation.insert(elevation.end(), c.rasters.begin(), c.rasters.end());
    std::move(c.diagnostics.messages.begin(), c.diagnostics.messages.end(),
              std::back_inserter(result.diagnostics.messages));
    std::move(c.diagnostics.leftOut.begin(), c.diagnostics.leftOut.end(),
              std::back_inserter(result.diagnostics.leftOut));
  }

  // A city CRS in degrees or feet is brought to metres like any other.
  const std::string crs = !named.empty() && kindOf(named).geographic ? std::string() : named;
  result.city = assembleCity(std::move(found), elevation, {crs, fallback}, options, messages, result.diagnostics);
  if (result.city) {
    result.city->name = scene.name;
    applyScene(*result.city, scene, options.shift, result.diagnostics);
  } else if (!result.diagnostics.hasErrors()) {
    const std::string& first = !scene.file.empty() || scene.sources.empty() ? scene.file : scene.sources[0].file;
    result.diagnostics.error(first, "", "holds neither buildings nor terrain");
  }
  return result;
}

/// The scene's file in the cache, and the hash of all that its city is made from.
struct CachePlace {
  fs::path file;
  std::string hash;
};

CachePlace cachePlaceOf(std::span<const std::string> inputs, const SceneDescription& scene,
                        const LoadOptions& options) {
  Hash64 key;
  std::error_code error;
  std::vector<std::string> files;
  for (const SceneSource& s : scene.sources) files.push_back(s.file);
  files.insert(files.end(), scene.terrain.files.begin(), scene.terrain.files.end());
  for (const SceneMonument& m : scene.monuments) files.push_back(m.file);
  for (const auto* list : {&scene.avatars.characters, &scene.avatars.motions})
    files.insert(files.end(), list->begin(), list->end());
  const std::vector<std::string> rules = ownRulesOf(scene);
  files.insert(files.end(), rules.begin(), rules.end());
  for (const std::string& file : inputs) key.addText(fs::absolute(file, error).string());
  key.addNumber(files.size());
  for (const std::string& file : files) key.addText(fs::absolute(file, error).string());
  for (const std::string& text : {options.heightColumn, options.groundColumn, options.crs, options.terrainUnit})
    key.addText(text);
  for (const double shift : {options.shift.x, options.shift.y, options.shift.z, options.lod})
    key.addNumber(std::bit_cast<uint64_t>(shift));
  Hash64 content = key;
  if (!scene.file.empty()) addContent(content, scene.file);
  for (const std::string& file : files) {
    addContent(content, file);
    for (const std::string& named : filesNamedIn(file)) addContent(content, named);
  }
  const std::string name = inputs.empty() ? "city" : fs::path(inputs[0]).stem().string();
  return {fs::path(options.cacheFolder) / (name + "-" + key.text() + ".sqlite"), content.text()};
}

/// An open cache and what it has to say.
struct CacheFile {
  explicit CacheFile(const fs::path& file) : cache(file, diagnostics) {}
  city::Diagnostics diagnostics;
  BlobCache cache;
};

/// The city as it was when these files were last read, else as they are read now.
LoadResult loadThroughCache(std::span<const std::string> inputs, const SceneDescription& scene,
                            const LoadOptions& options) {
  constexpr std::string_view kKind = "city";
  if (options.progress) options.progress("cache", 0);
  const CachePlace place = cachePlaceOf(inputs, scene, options);
  auto file = std::make_unique<CacheFile>(place.file);
  LoadResult result;
  if (const auto bytes = file->cache.read(kKind, place.hash, kBuilderVersion)) {
    if (auto cached = decodeCity(*bytes))
      result.city = std::move(cached->city), result.diagnostics = std::move(cached->diagnostics),
      result.fromCache = true;
    else
      file->diagnostics.warn(place.file.string(), "", "the city in the cache is damaged and is made anew");
  }
  std::string fresh;
  if (!result.fromCache) {
    result = loadScene(scene, options);
    if (result.city) {
      CachedCity whole{std::move(*result.city), std::move(result.diagnostics)};
      fresh = encodeCity(whole);
      result.city = std::move(whole.city);
      result.diagnostics = std::move(whole.diagnostics);
    }
  }
  auto& messages = result.diagnostics.messages;
  messages.insert(messages.end(), file->diagnostics.messages.begin(), file->diagnostics.messages.end());
  if (!fresh.empty()) {
    file->diagnostics = {};
    result.cached = std::async(std::launch::async,
                               [file = std::move(file), fresh = std::move(fresh), hash = place.hash, kind = kKind] {
                                 file->cache.write(kind, hash, kBuilderVersion, fresh);
                                 return std::move(file->diagnostics);
                               });
  }
  return result;
}

}  // namespace

LoadResult loadCity(std::span<const std::string> inputs, const LoadOptions& options) {
  LoadResult result;
  try {
    for (const std::string& input : inputs) {
      if (!isBuiltIn(input)) continue;
      if (inputs.size() > 1 || !options.elevation.empty()) {
        result.diagnostics.error(input, "", "a built-in scene stands alone: name no other files with it");
        return result;
      }
      return loadBuiltIn(input, options);
    }
    const std::optional<SceneDescription> scene = sceneOf(inputs, options, result.diagnostics);
    if (!scene) return result;
    result = options.cacheFolder.empty() ? loadScene(*scene, options) : loadThroughCache(inputs, *scene, options);
    result.settings = scene->knobs;
    result.rulesFiles = ownRulesOf(*scene);
    result.descriptionFile = scene->file;
    return result;
  } catch (const std::exception& e) {
    result.city.reset();
    result.diagnostics.error(inputs.empty() ? "" : inputs[0], "", std::string("could not be loaded: ") + e.what());
    return result;
  }
}

}  // namespace vicus::assets
