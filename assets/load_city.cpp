#include "assets/load_city.hpp"

#include <gdal_priv.h>

#include <bit>
#include <charconv>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "assets/cache/blob_cache.hpp"
#include "assets/cache/builder_version.hpp"
#include "assets/cache/city_codec.hpp"
#include "assets/cache/hash.hpp"
#include "assets/import/gdal_messages.hpp"
#include "assets/import/import_city.hpp"
#include "assets/import/projection.hpp"
#include "assets/import/read_cityjson.hpp"
#include "assets/import/read_elevation.hpp"
#include "assets/import/read_footprints.hpp"
#include "assets/norvic/norvic.hpp"

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

struct CloseDataset {
  void operator()(GDALDataset* d) const { GDALClose(d); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// The files of one city while they are read.
struct Input {
  const LoadOptions& options;
  city::Diagnostics& diagnostics;
  GdalMessages messages;
  std::string crs;  ///< WKT of what the user says of files without one
  std::vector<Source> sources;
  std::vector<Dataset> datasets;  ///< keeps rasters open
  std::vector<ElevationRaster> rasters;
};

bool endsWithJson(const std::string& file) {
  return file.ends_with(".json") || file.ends_with(".JSON") || file.ends_with(".cityjson");
}

/// Reads a whole file; nothing, with an error, where it cannot be read.
std::optional<std::string> readText(const std::string& file, city::Diagnostics& diagnostics) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream) {
    diagnostics.error(file, "", "cannot be read");
    return std::nullopt;
  }
  return std::move(text).str();
}

void addRaster(Input& input, Dataset dataset, const std::string& file) {
  if (const std::string why = whyNoElevation(*dataset); !why.empty()) {
    input.diagnostics.error(file, "", "cannot be terrain: " + why);
    return;
  }
  ElevationRaster raster{dataset.get(), file, {}};
  const char* wkt = dataset->GetProjectionRef();
  if (wkt && *wkt) raster.crs = crsFromText(wkt);
  if (raster.crs.empty()) raster.crs = input.crs;
  if (raster.crs.empty()) {
    input.diagnostics.error(file, "", "states no CRS: give one with --crs");
    return;
  }
  input.rasters.push_back(std::move(raster));
  input.datasets.push_back(std::move(dataset));
}

void readFile(Input& input, const std::string& file, bool elevationOnly) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    input.diagnostics.error(file, "", "there is no such file");
    return;
  }
  if (!elevationOnly && endsWithJson(file) && fs::is_regular_file(file, error)) {
    const auto text = readText(file, input.diagnostics);
    if (!text) return;
    if (isCityJson(*text) || file.ends_with(".city.json") || file.ends_with(".cityjson")) {
      Source source = readCityJson(*text, file, input.options.heightColumn, input.diagnostics);
      if (source.crs.empty()) source.crs = input.crs;
      input.sources.push_back(std::move(source));
      return;
    }
  }
  Dataset dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_READONLY | GDAL_OF_RASTER | (elevationOnly ? 0 : GDAL_OF_VECTOR)));
  if (!dataset) {
    const std::string why = input.messages.take();
    input.diagnostics.error(
        file, "",
        elevationOnly ? "cannot be read as terrain" + (why.empty() ? "" : ": " + why)
                      : "is neither footprints nor CityJSON nor a terrain raster" + (why.empty() ? "" : ": " + why));
    return;
  }
  if (!elevationOnly && dataset->GetLayerCount() > 0) {
    Source source = readFootprints(*dataset, file, {input.options.heightColumn, input.options.groundColumn},
                                   input.messages, input.diagnostics);
    if (source.crs.empty()) source.crs = input.crs;
    if (source.footprints.empty()) input.diagnostics.error(file, "", "holds no building footprints");
    input.sources.push_back(std::move(source));
    if (dataset->GetRasterCount() == 0) return;
  }
  addRaster(input, std::move(dataset), file);
}

LoadResult loadFiles(std::span<const std::string> inputs, const LoadOptions& options) {
  LoadResult result;
  Input input{options, result.diagnostics, {}, {}, {}, {}, {}};
  if (!options.crs.empty()) {
    input.crs = crsFromText(options.crs);
    if (input.crs.empty()) result.diagnostics.error("--crs", "", "the CRS " + options.crs + " is not known");
  }
  size_t done = 0;
  const size_t all = inputs.size() + options.elevation.size();
  const auto read = [&](const std::string& file, bool elevationOnly) {
    if (options.progress)
      options.progress("reading " + fs::path(file).filename().string(),
                       static_cast<double>(done) / static_cast<double>(all));
    readFile(input, file, elevationOnly);
    ++done;
  };
  for (const std::string& file : inputs) read(file, false);
  for (const std::string& file : options.elevation) read(file, true);

  result.city = assembleCity(std::move(input.sources), input.rasters, options, input.messages, result.diagnostics);
  if (result.city)
    result.city->name = inputs.empty() ? "" : fs::path(inputs[0]).stem().string();
  else if (!result.diagnostics.hasErrors())
    result.diagnostics.error(inputs.empty() ? "" : inputs[0], "", "holds neither buildings nor terrain");
  return result;
}

/// The scene's file in the cache, and the hash of all that its city is made from.
struct CachePlace {
  fs::path file;
  std::string hash;
};

CachePlace cachePlaceOf(std::span<const std::string> inputs, const LoadOptions& options) {
  Hash64 scene;
  std::error_code error;
  for (const auto& list : {inputs, std::span<const std::string>(options.elevation)}) {
    scene.addNumber(list.size());
    for (const std::string& file : list) scene.addText(fs::absolute(file, error).string());
  }
  for (const std::string& text : {options.heightColumn, options.groundColumn, options.crs}) scene.addText(text);
  for (const double shift : {options.shift.x, options.shift.y, options.shift.z})
    scene.addNumber(std::bit_cast<uint64_t>(shift));
  Hash64 content = scene;
  for (const auto& list : {inputs, std::span<const std::string>(options.elevation)})
    for (const std::string& file : list) addContent(content, file);
  const std::string name = inputs.empty() ? "city" : fs::path(inputs[0]).stem().string();
  return {fs::path(options.cacheFolder) / (name + "-" + scene.text() + ".sqlite"), content.text()};
}

/// An open cache and what it has to say.
struct CacheFile {
  explicit CacheFile(const fs::path& file) : cache(file, diagnostics) {}
  city::Diagnostics diagnostics;
  BlobCache cache;
};

/// The city as it was when these files were last read, else as they are read now.
LoadResult loadThroughCache(std::span<const std::string> inputs, const LoadOptions& options) {
  constexpr std::string_view kKind = "city";
  if (options.progress) options.progress("cache", 0);
  const CachePlace place = cachePlaceOf(inputs, options);
  auto file = std::make_unique<CacheFile>(place.file);
  LoadResult result;
  if (const auto bytes = file->cache.read(kKind, place.hash, kBuilderVersion)) {
    if (auto cached = decodeCity(*bytes))
      result = {std::move(cached->city), std::move(cached->diagnostics), true, {}};
    else
      file->diagnostics.warn(place.file.string(), "", "the city in the cache is damaged and is made anew");
  }
  std::string fresh;
  if (!result.fromCache) {
    result = loadFiles(inputs, options);
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
    return options.cacheFolder.empty() ? loadFiles(inputs, options) : loadThroughCache(inputs, options);
  } catch (const std::exception& e) {
    result.city.reset();
    result.diagnostics.error(inputs.empty() ? "" : inputs[0], "", std::string("could not be loaded: ") + e.what());
    return result;
  }
}

}  // namespace vicus::assets
