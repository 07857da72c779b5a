#include "report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace vicus::report {
namespace {

// Sizes in SVG units, which are pixels at full width.
constexpr double kWidth = 600, kHeight = 380, kBarsWidth = 980;
constexpr double kLeft = 64, kRight = 20, kTop = 16, kBottom = 52;
constexpr double kZeroRow = 30;  // height of the row of zeros below the plot
constexpr double kLetter = 6.4;  // mean width of a letter of the labels
constexpr double kLabelHeight = 14;

/// A logarithmic axis from `low` to `high` over pixels `from` to `to`.
struct LogAxis {
  double low = 1, high = 10, from = 0, to = 1;
  double at(double value) const { return from + (to - from) * std::log(value / low) / std::log(high / low); }
};

/// Spans all values with some air, over at least a factor of 3.
LogAxis axisFor(const std::vector<double>& values, double from, double to) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double air = std::max(std::pow(*most / *least, 0.08), std::sqrt(3 / std::min(3.0, *most / *least)) * 1.05);
  return {*least / air, *most * air, from, to};
}

/// 1, 2 and 5 of each decade within the axis; only the decades where there would be too many.
std::vector<double> ticksOf(const LogAxis& axis) {
  std::vector<double> ticks;
  const bool wide = axis.high / axis.low > 1e4;
  for (int decade = static_cast<int>(std::floor(std::log10(axis.low))); std::pow(10.0, decade) <= axis.high; ++decade)
    for (const double step : {1.0, 2.0, 5.0}) {
      const double tick = step * std::pow(10.0, decade);
      if (tick >= axis.low && tick <= axis.high && (step == 1 || !wide)) ticks.push_back(tick);
    }
  return ticks;
}

/// A tick's number without trailing zeros.
std::string tickText(double value) {
  return fmt::format("{:g}", value);
}

struct Rectangle {
  double x0, y0, x1, y1;
  bool touches(const Rectangle& r) const { return x0 < r.x1 && r.x0 < x1 && y0 < r.y1 && r.y0 < y1; }
};

/// Writes each label beside its point where it covers no other label and no point; the others are left to hovering.
std::string placeLabels(const std::vector<std::pair<glm::dvec2, const PlotPoint*>>& points, const Rectangle& plot) {
  std::vector<Rectangle> taken;
  for (const auto& [p, point] : points) taken.push_back({p.x - 5, p.y - 5, p.x + 5, p.y + 5});
  std::string out;
  for (const auto& [p, point] : points) {
    if (point->label.empty()) continue;
    const double width = kLetter * static_cast<double>(point->label.size());
    const std::array<glm::dvec2, 4> starts{
        {{p.x + 9, p.y + 4}, {p.x - 9 - width, p.y + 4}, {p.x - width / 2, p.y - 10}, {p.x - width / 2, p.y + 19}}};
    for (const glm::dvec2& s : starts) {
      const Rectangle box{s.x, s.y - kLabelHeight + 3, s.x + width, s.y + 3};
      const bool inside = box.x0 >= plot.x0 && box.x1 <= plot.x1 && box.y0 >= plot.y0 && box.y1 <= plot.y1;
      if (!inside || std::ranges::any_of(taken, [&](const Rectangle& r) { return r.touches(box); })) continue;
      taken.push_back(box);
      out += fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", s.x, s.y, escaped(point->label));
      break;
    }
  }
  return out;
}

std::string hoverAttribute(const std::string& text) {
  return text.empty() ? "" : fmt::format(" tabindex=\"0\" data-tip=\"{}\"", escaped(text));
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string shortNumber(double value) {
  if (!std::isfinite(value)) return "–";
  const double size = std::abs(value);
  if (size >= 9.995e8) return fmt::format("{:.3g} G", value / 1e9);
  if (size >= 9.995e5) return fmt::format("{:.3g} M", value / 1e6);
  if (size >= 9999.5) return fmt::format("{:.3g} k", value / 1e3);
  if (size >= 99.95 || value == std::round(value)) return fmt::format("{:.0f}", value);
  if (size >= 9.995) return fmt::format("{:.1f}", value);
  if (size >= 0.9995) return fmt::format("{:.2f}", value);
  if (size >= 1e-4) return fmt::format("{:.{}f}", value, 2 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.1e}", value);
}

std::string_view seriesColour(size_t index) {
  constexpr std::array<std::string_view, 8> kColours{"#1f6f9f", "#c8702a", "#3c8a63", "#a5508f",
                                                     "#8f2f22", "#7a7420", "#4c5b9c", "#5f6a70"};
  return kColours[index % kColours.size()];
}

std::string errorTimePlot(const std::vector<PlotSeries>& series, const PlotText& text) {
  const auto drawn = [](const PlotPoint& p) { return std::isfinite(p.x.value) && p.x.value > 0 && std::isfinite(p.y); };
  std::vector<double> xs, ys;
  bool zeros = false;
  for (const PlotSeries& s : series)
    for (const PlotPoint& p : s.points) {
      if (!drawn(p)) continue;
      xs.insert(xs.end(), {p.x.value, p.x.low > 0 ? p.x.low : p.x.value, std::max(p.x.high, p.x.value)});
      if (p.y > 0)
        ys.push_back(p.y);
      else
        zeros = true;
    }
  if (xs.empty()) return {};
  const bool onlyZeros = ys.empty();
  if (onlyZeros) ys = {0.001, 0.1};

  const double bottom = kHeight - kBottom - (zeros ? kZeroRow : 0);
  const double zeroAt = kHeight - kBottom - kZeroRow / 2;
  const LogAxis xAxis = axisFor(xs, kLeft, kWidth - kRight), yAxis = axisFor(ys, bottom, kTop);
  const Rectangle plot{kLeft, kTop, kWidth - kRight, kHeight - kBottom};

  std::string out = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\"><rect class=\"ground\" x=\"{}\" "
      "y=\"{}\" "
      "width=\"{}\" height=\"{}\"/>",
      kWidth, kHeight, escaped(text.title), plot.x0, plot.y0, plot.x1 - plot.x0, plot.y1 - plot.y0);
  // The better corner.
  out += fmt::format(
      "<path class=\"better\" d=\"M{0} {1}h{2}L{0} {3}Z\"/><text class=\"better\" x=\"{4}\" "
      "y=\"{5}\">faster and more faithful</text>",
      plot.x0, plot.y1, 0.42 * (plot.x1 - plot.x0), plot.y1 - 0.42 * (plot.y1 - plot.y0), plot.x0 + 10, plot.y1 - 10);

  // Axes.
  for (const double tick : ticksOf(xAxis))
    out += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick\" "
        "x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>",
        xAxis.at(tick), plot.y0, plot.y1, plot.y1 + 18, tickText(tick));
  if (!onlyZeros)
    for (const double tick : ticksOf(yAxis))
      out += fmt::format(
          "<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/><text "
          "class=\"tick\" x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>",
          yAxis.at(tick), plot.x0, plot.x1, plot.x0 - 8, yAxis.at(tick) + 4, tickText(tick));
  if (zeros)
    out += fmt::format(
        "<line class=\"break\" x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\"/><text class=\"tick\" x=\"{}\" "
        "y=\"{}\" text-anchor=\"end\">0</text>",
        plot.x0, plot.x1, bottom, bottom, plot.x0 - 8, zeroAt + 4);
  out += fmt::format("<text class=\"axis\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>", (plot.x0 + plot.x1) / 2,
                     kHeight - 10, escaped(text.xAxis));
  out += fmt::format("<text class=\"axis\" transform=\"translate(15 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                     (plot.y0 + plot.y1) / 2, escaped(text.yAxis));

  // Lines first, then intervals, then points on top.
  std::vector<std::pair<glm::dvec2, const PlotPoint*>> places;
  std::string marks;
  for (size_t i = 0; i < series.size(); ++i) {
    const std::string_view colour = seriesColour(i);
    std::string line;
    for (const PlotPoint& p : series[i].points) {
      if (!drawn(p)) continue;
      const glm::dvec2 at{xAxis.at(p.x.value), p.y > 0 ? yAxis.at(p.y) : zeroAt};
      places.emplace_back(at, &p);
      line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", at.x, at.y);
      if (p.x.low > 0 && p.x.high > p.x.low)
        marks += fmt::format(
            "<line stroke=\"{}\" class=\"interval\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" "
            "y2=\"{:.1f}\"/>",
            colour, xAxis.at(p.x.low), xAxis.at(p.x.high), at.y, at.y);
      if (p.marked)
        marks += fmt::format("<circle class=\"ring\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\" stroke=\"{}\"/>", at.x, at.y,
                             colour);
      marks += fmt::format("<circle class=\"point\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\"{}/>", at.x, at.y,
                           colour, hoverAttribute(p.hover));
    }
    if (series[i].joined) out += fmt::format("<path class=\"line\" d=\"{}\" stroke=\"{}\"/>", line, colour);
  }
  return out + marks + placeLabels(places, plot) + "</svg>";
}

std::string stackedBars(const std::vector<StackedBar>& bars, const std::string& unit, const std::string& title) {
  std::vector<std::string> names;
  double longest = 0;
  size_t longestName = 0;
  for (const StackedBar& bar : bars) {
    double total = 0;
    for (const auto& [name, length] : bar.parts) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      total += length;
    }
    longest = std::max(longest, total);
    longestName = std::max(longestName, bar.name.size());
  }
  if (!(longest > 0)) return {};

  constexpr double kBar = 18, kStep = 27, kRoomForTotal = 78;
  const double left = std::min(300.0, 14 + 7.2 * static_cast<double>(longestName));
  const double scale = (kBarsWidth - left - kRoomForTotal) / longest;
  std::string out = fmt::format("<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", kBarsWidth,
                                kStep * static_cast<double>(bars.size()) + 6, escaped(title));
  double y = 4;
  for (const StackedBar& bar : bars) {
    out += fmt::format("<text class=\"label\" x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>", left - 8, y + 13,
                       escaped(bar.name));
    double x = left;
    for (const auto& [name, length] : bar.parts) {
      const auto index = static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
      out += fmt::format("<rect class=\"part\" x=\"{:.1f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\"{}/>", x,
                         y, length * scale, kBar, seriesColour(index),
                         hoverAttribute(fmt::format("{}\n{}: {} {}", bar.name, name, shortNumber(length), unit)));
      x += length * scale;
    }
    out += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\">{} {}</text>", x + 7, y + 13,
                       shortNumber((x - left) / scale), escaped(unit));
    y += kStep;
  }
  out += "</svg><p class=\"legend\">";
  for (size_t i = 0; i < names.size(); ++i)
    out += fmt::format("<span><i style=\"background:{}\"></i>{}</span> ", seriesColour(i), escaped(names[i]));
  return out + "</p>";
}

}  // namespace vicus::report
