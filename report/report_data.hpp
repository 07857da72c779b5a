/// Everything that a report says, as plain values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "city/stability.hpp"
#include "report/statistics.hpp"
#include "viewer/measure.hpp"
#include "viewer/renderer.hpp"

namespace vicus::report {

/// Values by name, in the order in which they are shown.
template <typename T>
using Named = std::vector<std::pair<std::string, T>>;

/// What a configuration's pictures lack. A figure that was not measured is nothing.
struct ErrorFigures {
  /// Pixels of a building or monument that the item buffer of everything shows and the plan leaves out, over all views.
  std::optional<double> falselyCulledPixels;
  std::vector<uint32_t> lostItems;         ///< ids of those, at most kLostItemsListed
  std::optional<double> drawnOverVisible;  ///< instances drawn ÷ instances with a pixel, over all views together
  std::optional<double> rmse;              ///< of sRGB values in 0 … 1, mean over the pictures
  std::optional<double> psnr;              ///< dB, mean over the pictures; kEqualPsnr for equal ones
  std::optional<double> ssim;              ///< mean over the pictures
  std::optional<double> flip;              ///< mean FLIP, mean over the pictures
  std::optional<double> popping;           ///< largest jump of mean FLIP between consecutive frames of a slow approach
  std::optional<double> geometricPixels;   ///< largest displacement that the techniques themselves admit, pixels
  std::array<int, 2> shift{0, 0};          ///< pixels right and down that all pictures are moved by
};
constexpr size_t kLostItemsListed = 16;
constexpr double kEqualPsnr = 100;  ///< stands for infinity, which JSON has not

struct FeatureFigures {
  bool on = false;
  std::string why;
};

struct MemoryFigures {
  double peakResidentMb = 0;
  double gpuMb = 0;
};

/// One configuration on one tour.
struct RunFigures {
  std::string name;  ///< all_off, only_FEATURE, all_on, all_on_less_FEATURE, visibility, limit
  std::string path;  ///< the tour
  int frames = 0;    ///< timed
  Named<double> knobs;
  Named<FeatureFigures> features;
  viewer::Percentiles frame;               ///< milliseconds
  std::optional<viewer::Percentiles> gpu;  ///< milliseconds; nothing where the driver tells none
  Estimate frameMedian;                    ///< milliseconds
  Named<viewer::Percentiles> stages;       ///< milliseconds, in the order run
  Named<double> leastStages;               ///< milliseconds, the quickest frame's: noise only adds to it
  Named<viewer::MeanMax> counts;           ///< tiles, …, triangles, draw_calls, texture_binds, …
  MemoryFigures memory;
  ErrorFigures error;
};

/// How many times faster a run is than another that was interleaved with it.
struct Speedup {
  std::string run, path;
  std::string over;  ///< "all_off"
  Estimate ratio;    ///< median frame of `over` ÷ median frame of `run`
};

struct CurvePoint {
  double value = 0;  ///< of the knob
  bool isDefault = false;
  Estimate milliseconds;  ///< median frame
  ErrorFigures error;
};

/// A technique's knob from end to end.
struct Curve {
  std::string technique, knob, unit, path;
  std::vector<CurvePoint> points;  ///< in the order of the knob's values
};

/// A part of the program that this scene does not need, or a part of the input that is not in the city.
struct LeftOutFigures {
  std::string what, why;
  std::optional<double> count;              ///< of the input's things
  std::optional<double> savedMilliseconds;  ///< a frame
  std::optional<double> savedMb;
};

/// One place of one tour, for people to look at. Pictures are already reduced.
struct PictureRow {
  std::string run, path;
  int frame = 0;
  double flip = 0;  ///< mean, at full size
  viewer::Picture reference, picture, errors;
};

struct ReportData {
  std::string scene, renderer;
  std::array<int, 2> size{0, 0};  ///< pixels of the timed frames
  bool quick = false;
  bool complete = false;           ///< false: interrupted, holds what was done until then
  double seconds = 0;              ///< that the report took
  std::vector<std::string> notes;  ///< how it was measured, where that differs from what the words mean elsewhere
  std::vector<RunFigures> runs;
  std::vector<Speedup> speedups;
  std::vector<Curve> curves;
  std::vector<city::StabilityRow> stability;
  std::vector<LeftOutFigures> leftOut;
  std::vector<std::string> findings;  ///< what is wrong, in plain words; see findings.hpp
  std::vector<PictureRow> pictures;   ///< on the page only
};

/// Runs of one tour in their order.
std::vector<const RunFigures*> runsOn(const ReportData& report, const std::string& path);
/// The run, or null.
const RunFigures* findRun(const ReportData& report, const std::string& name, const std::string& path);
/// The names of the tours in the order of their first runs.
std::vector<std::string> pathsOf(const ReportData& report);
/// The value of that name, or null.
template <typename T>
const T* find(const Named<T>& values, const std::string& name) {
  for (const auto& [key, value] : values)
    if (key == name) return &value;
  return nullptr;
}

}  // namespace vicus::report
