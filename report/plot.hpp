/// Plots as SVG text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/statistics.hpp"

namespace vicus::report {

/// `text` with what HTML takes for markup escaped.
std::string escaped(std::string_view text);

/// A number with about three digits: 0.0312, 4.27, 28.1, 874, 1.24 M. Not finite: –.
std::string shortNumber(double value);

/// The colour of the `index`th thing of a kind: dark enough to read on paper, told apart by colour-blind eyes (after
/// Okabe and Ito 2008), again from the start after the eighth.
std::string_view seriesColour(size_t index);

struct PlotPoint {
  Estimate x;
  double y = 0;
  std::string label;    ///< written beside the point where there is room
  std::string hover;    ///< shown when the pointer rests on it; lines end in \n
  bool marked = false;  ///< drawn with a ring: the default setting
};

struct PlotSeries {
  std::string name;
  bool joined = false;  ///< a line through the points in their order
  std::vector<PlotPoint> points;
};

struct PlotText {
  std::string title;  ///< for screen readers
  std::string xAxis, yAxis;
};

/// Points over two logarithmic axes, the lower left corner, where both are small, shaded as the better one. Values of y
/// that are 0 or less stand in a row of their own below the axis, marked 0. Points that are not finite, or with x ≤ 0,
/// are left out; with no points left the text is empty.
std::string errorTimePlot(const std::vector<PlotSeries>& series, const PlotText& text);

/// A bar made of parts, for a list of bars that share a scale.
struct StackedBar {
  std::string name;
  std::vector<std::pair<std::string, double>> parts;  ///< name and length, ≥ 0
};

/// Bars below each other from a common 0, a part of one name in one colour, with a legend.
std::string stackedBars(const std::vector<StackedBar>& bars, const std::string& unit, const std::string& title);

}  // namespace vicus::report
