#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/flip.hpp"
#include "report/page_style.hpp"
#include "report/picture_bytes.hpp"
#include "report/plot.hpp"
#include "viewer/pictures.hpp"

namespace vicus::report {
namespace {

constexpr std::string_view kOnly = "only_", kLess = "all_on_less_";

/// "frustum_culling" → "frustum culling".
std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// What a configuration is, for people.
std::string configurationTitle(const std::string& name) {
  if (name == "all_off") return "Everything off";
  if (name == "all_on") return "Everything on";
  if (name == "visibility") return "Visibility alone";
  if (name == "limit") return "Perfect visibility";
  if (name.starts_with(kOnly)) return "Only " + spoken(name.substr(kOnly.size()));
  if (name.starts_with(kLess)) return "All but " + spoken(name.substr(kLess.size()));
  return spoken(name);
}

std::string pathTitle(const std::string& path) {
  if (path == "street") return "Walking down the street";
  if (path == "flyover") return "Flying over";
  if (path == "turn") return "Turning round on the spot";
  if (path == "teleport") return "Jumping from place to place";
  return spoken(path);
}

std::string figure(const std::optional<double>& value) {
  return value ? shortNumber(*value) : "–";
}

std::string interval(const Estimate& e) {
  return fmt::format("{} to {}", shortNumber(e.low), shortNumber(e.high));
}

const Speedup* speedupOf(const ReportData& report, const RunFigures& run) {
  for (const Speedup& s : report.speedups)
    if (s.run == run.name && s.path == run.path && s.over == "all_off") return &s;
  return nullptr;
}

double meanCount(const RunFigures& run, const std::string& name) {
  const viewer::MeanMax* count = find(run.counts, name);
  return count == nullptr ? NAN : count->mean;
}

// ---- header and summary --------------------------------------------------------------------------------------------

std::string header(const ReportData& report) {
  std::string out = fmt::format(
      "<header><p class=\"eyebrow\">Vicus · error against run time</p><h1>{}</h1><p class=\"facts\"><span>{}</span>"
      "<span>{} × {} pixels</span><span>{} report</span><span>measured in {:.0f} s</span></p></header>",
      escaped(report.scene), escaped(report.renderer), report.size[0], report.size[1], report.quick ? "quick" : "full",
      report.seconds);
  if (!report.complete)
    out +=
        "<div class=\"findings\"><h2>Not finished</h2><p>The report was interrupted. What follows was measured "
        "until then.</p></div>";
  return out;
}

std::string summaryOf(const ReportData& report, const std::string& path) {
  const RunFigures* on = findRun(report, "all_on", path);
  const RunFigures* off = findRun(report, "all_off", path);
  const RunFigures* limit = findRun(report, "limit", path);
  if (on == nullptr || off == nullptr) return {};
  std::string out =
      fmt::format("<p><b>{}.</b> With everything on, a frame takes {} ms; with everything off, {} ms.", pathTitle(path),
                  shortNumber(on->frameMedian.value), shortNumber(off->frameMedian.value));
  if (const Speedup* s = speedupOf(report, *on))
    out += fmt::format(" That is {} times as fast (95 % sure: {}).", shortNumber(s->ratio.value), interval(s->ratio));
  if (limit != nullptr)
    out +=
        fmt::format(" If only what can be seen were drawn, it would be {} ms.", shortNumber(limit->frameMedian.value));
  if (on->error.falselyCulledPixels)
    out += *on->error.falselyCulledPixels == 0 ? " No pixel of a visible building is missing."
                                               : " <span class=\"bad\">Visible buildings are missing.</span>";
  if (on->error.flip && off->error.flip)
    out += fmt::format(" The picture differs from a perfect one by a FLIP of {}, against {} with everything off.",
                       shortNumber(*on->error.flip), shortNumber(*off->error.flip));
  return out + "</p>";
}

std::string summary(const ReportData& report) {
  std::string out = "<section class=\"summary\">";
  for (const std::string& path : pathsOf(report)) out += summaryOf(report, path);
  out += "</section>";
  if (report.findings.empty()) return out + "<div class=\"fine\"><p>No faults found.</p></div>";
  out += "<div class=\"findings\"><h2>Faults found</h2><ul>";
  for (const std::string& finding : report.findings) out += fmt::format("<li>{}</li>", escaped(finding));
  return out + "</ul></div>";
}

// ---- headline table ------------------------------------------------------------------------------------------------

/// The median as a bar with its interval, on a scale that all rows of a table share.
std::string medianBar(const Estimate& e, double longest) {
  constexpr double kBarWidth = 90;
  const double scale = kBarWidth / longest;
  return fmt::format(
      "<svg class=\"bar\" width=\"{0}\" height=\"12\" aria-hidden=\"true\"><rect y=\"2\" width=\"{1:.1f}\" "
      "height=\"8\" fill=\"#c9c2b2\"/><line x1=\"{2:.1f}\" x2=\"{3:.1f}\" y1=\"6\" y2=\"6\" "
      "stroke=\"#24272b\" stroke-width=\"2\"/></svg>",
      kBarWidth + 4, e.value * scale, e.low * scale, e.high * scale);
}

std::string headlineRow(const ReportData& report, const RunFigures& run, double longest) {
  std::string out = fmt::format("<tr{}><td>{}<code>{}</code></td>",
                                run.name == "all_off" || run.name == "limit" ? " class=\"base\"" : "",
                                configurationTitle(run.name), escaped(run.name));
  out += fmt::format("<td>{}<br><small>{}</small></td><td>{}</td>", shortNumber(run.frameMedian.value),
                     interval(run.frameMedian), medianBar(run.frameMedian, longest));
  const Speedup* speedup = speedupOf(report, run);
  out += speedup == nullptr ? "<td>–</td>"
                            : fmt::format("<td>{} ×<br><small>{}</small></td>", shortNumber(speedup->ratio.value),
                                          interval(speedup->ratio));
  for (const char* count : {"triangles", "draw_calls", "texture_binds"})
    out += fmt::format("<td>{}</td>", shortNumber(meanCount(run, count)));
  const ErrorFigures& e = run.error;
  out += fmt::format("<td{}>{}</td>", e.falselyCulledPixels.value_or(0) > 0 ? " class=\"bad\"" : "",
                     figure(e.falselyCulledPixels));
  for (const auto& value : {e.drawnOverVisible, e.rmse, e.psnr, e.flip, e.popping, e.geometricPixels})
    out += fmt::format("<td>{}</td>", figure(value));
  return out + "</tr>";
}

std::string headlineTable(const ReportData& report) {
  std::string out =
      "<section><h2>All configurations</h2><p class=\"lead\">Each technique alone, all together, and all but one. The "
      "configurations took turns frame by frame, so that whatever else the machine was doing hit all of them alike. "
      "Small figures are the ends of the 95 % interval.</p>";
  for (const std::string& path : pathsOf(report)) {
    const auto runs = runsOn(report, path);
    double longest = 1e-9;
    for (const RunFigures* run : runs) longest = std::max(longest, run->frameMedian.high);
    out += fmt::format(
        "<h3>{}</h3><div class=\"wide\"><table><thead><tr><th></th><th class=\"group\" colspan=\"3\">Run time</th>"
        "<th class=\"group\" colspan=\"3\">Drawn for each frame</th><th class=\"group\" "
        "colspan=\"7\">Error</th></tr><tr>"
        "<th>Configuration</th><th>Frame<small>ms, median</small></th><th></th><th>Faster than all off</th>"
        "<th>Triangles</th><th>Draw calls</th><th>Texture binds</th><th>Lost pixels</th><th>Drawn ÷ visible</th>"
        "<th>RMSE</th><th>PSNR<small>dB</small></th><th>FLIP</th><th>Popping</th><th>Geometric<small>pixels</small></"
        "th>"
        "</tr></thead><tbody>",
        pathTitle(path));
    for (const RunFigures* run : runs) out += headlineRow(report, *run, longest);
    out += "</tbody></table></div>";
  }
  return out + "</section>";
}

// ---- curves --------------------------------------------------------------------------------------------------------

std::string errorLines(const ErrorFigures& e) {
  std::string out;
  if (e.flip) out += fmt::format("\nFLIP {}", shortNumber(*e.flip));
  if (e.rmse) out += fmt::format("\nRMSE {}", shortNumber(*e.rmse));
  if (e.geometricPixels) out += fmt::format("\ngeometric {} px", shortNumber(*e.geometricPixels));
  return out;
}

std::string configurationPlot(const ReportData& report, const std::string& path) {
  PlotSeries group[3] = {{"one technique alone", false, {}}, {"all but one", false, {}}, {"in all", false, {}}};
  for (const RunFigures* run : runsOn(report, path)) {
    if (!run->error.flip) continue;
    const size_t index = run->name.starts_with(kOnly) ? 0 : run->name.starts_with(kLess) ? 1 : 2;
    group[index].points.push_back({run->frameMedian, *run->error.flip, configurationTitle(run->name),
                                   fmt::format("{}\n{} ms ({})", configurationTitle(run->name),
                                               shortNumber(run->frameMedian.value), interval(run->frameMedian)) +
                                       errorLines(run->error),
                                   run->name == "all_on"});
  }
  const std::string svg =
      errorTimePlot({group[0], group[1], group[2]}, {"Error against run time of all configurations",
                                                     "milliseconds for each frame", "mean FLIP against the reference"});
  if (svg.empty()) return {};
  return fmt::format(
      "<figure class=\"card\"><h3>{}</h3>{}<p class=\"legend\"><span><i style=\"background:{}\"></i>one "
      "technique alone</span><span><i style=\"background:{}\"></i>all but one</span><span><i "
      "style=\"background:{}\"></i>in all; ringed: everything on</span></p></figure>",
      pathTitle(path), svg, seriesColour(0), seriesColour(1), seriesColour(2));
}

std::string curvePlot(const Curve& curve) {
  PlotSeries series{curve.knob, true, {}};
  for (const CurvePoint& p : curve.points) {
    if (!p.error.flip) continue;
    series.points.push_back({p.milliseconds, *p.error.flip, shortNumber(p.value),
                             fmt::format("{} = {} {}\n{} ms ({})", curve.knob, shortNumber(p.value), curve.unit,
                                         shortNumber(p.milliseconds.value), interval(p.milliseconds)) +
                                 errorLines(p.error) + (p.isDefault ? "\nthe default" : ""),
                             p.isDefault});
  }
  const std::string svg = errorTimePlot({series}, {fmt::format("Error against run time over {}", curve.knob),
                                                   "milliseconds for each frame", "mean FLIP against the reference"});
  if (svg.empty()) return {};
  return fmt::format(
      "<figure class=\"card\"><h3>{}: <code>{}</code></h3>{}<figcaption>{}; the numbers are the knob's "
      "values{}, the default is ringed.</figcaption></figure>",
      escaped(spoken(curve.technique)), escaped(curve.knob), svg, pathTitle(curve.path),
      curve.unit.empty() ? "" : " in " + escaped(curve.unit));
}

std::string curves(const ReportData& report) {
  std::string plots;
  for (const std::string& path : pathsOf(report)) plots += configurationPlot(report, path);
  for (const Curve& curve : report.curves) plots += curvePlot(curve);
  if (plots.empty()) return {};
  return "<section><h2>Error against run time</h2><p class=\"lead\">Down is closer to a perfect picture, left is "
         "faster. "
         "The reference is the same view with everything drawn in full and sixteen samples for each pixel; nobody who "
         "draws with four can come closer to it than \"everything off\" does. Rest the pointer on a point for its "
         "figures.</p><div class=\"columns\">" +
         plots + "</div></section>";
}

// ---- pictures ------------------------------------------------------------------------------------------------------

std::string image(const viewer::Picture& picture, const std::string& alternative) {
  std::string error;  // a picture that cannot be shown leaves its words
  return fmt::format("<img loading=\"lazy\" width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">",
                     picture.width, picture.height, escaped(alternative), base64(viewer::pngBytes(picture, error)));
}

std::string errorRamp() {
  std::string stops;
  for (int i = 0; i <= 8; ++i) {
    const glm::u8vec3 c = errorColour(static_cast<float>(i) / 8);
    stops += fmt::format(",rgb({},{},{})", c.r, c.g, c.b);
  }
  return fmt::format("<span class=\"ramp\" style=\"background:linear-gradient(to right{})\"></span>", stops);
}

std::string pictures(const ReportData& report) {
  if (report.pictures.empty()) return {};
  std::string out = fmt::format(
      "<section><h2>Pictures and where they differ</h2><p class=\"lead\">Reference, what the program drew, and the "
      "difference that an eye would notice when flipping between the two (FLIP):{}none to as much as can be.</p>",
      errorRamp());
  for (const PictureRow& row : report.pictures)
    out += fmt::format(
        "<figure><div class=\"triple\">{}{}{}</div><figcaption>{}, frame {}: {}, mean FLIP "
        "{}.</figcaption></figure>",
        image(row.reference, "reference"), image(row.picture, "picture"), image(row.errors, "error map"),
        pathTitle(row.path), row.frame, configurationTitle(row.run), shortNumber(row.flip));
  return out + "</section>";
}

// ---- stages, stability, left out, words ----------------------------------------------------------------------------

std::string stages(const ReportData& report) {
  std::string out;
  for (const std::string& path : pathsOf(report)) {
    std::vector<StackedBar> bars;
    for (const RunFigures* run : runsOn(report, path)) {
      StackedBar bar{configurationTitle(run->name), {}};
      for (const auto& [name, ms] : run->stages) bar.parts.emplace_back(spoken(name), ms.median);
      bars.push_back(std::move(bar));
    }
    if (const std::string svg = stackedBars(bars, "ms", "Stages on " + path); !svg.empty())
      out += fmt::format("<figure class=\"card\"><h3>{}</h3>{}</figure>", pathTitle(path), svg);
  }
  if (out.empty()) return {};
  return "<section><h2>Where the time goes</h2><p class=\"lead\">Medians of each stage of a frame.</p>" + out +
         "</section>";
}

std::string stability(const ReportData& report) {
  if (report.stability.empty()) return {};
  std::vector<std::string> parts;
  for (const city::StabilityRow& row : report.stability)
    if (std::find(parts.begin(), parts.end(), row.part) == parts.end()) parts.push_back(row.part);
  std::string out =
      "<section><h2>Stiff and extreme cases</h2><p class=\"lead\">Cases at which programs of this kind break, each "
      "with "
      "a figure that must stay within its bound.</p>";
  for (const std::string& part : parts) {
    size_t all = 0, good = 0;
    std::string rows;
    for (const city::StabilityRow& row : report.stability) {
      if (row.part != part) continue;
      ++all;
      good += row.ok ? 1 : 0;
      rows += fmt::format(
          "<tr><td class=\"text\">{}</td><td class=\"text\">{}</td><td{}>{}</td><td>{}</td><td "
          "class=\"{}\">{}</td></tr>",
          escaped(row.caseName), escaped(row.what), row.ok ? "" : " class=\"bad\"", shortNumber(row.figure),
          shortNumber(row.bound), row.ok ? "ok" : "bad", row.ok ? "within" : "over");
    }
    out += fmt::format(
        "<details{}><summary><b>{}</b>: <span class=\"{}\">{} of {} within bounds</span></summary><div "
        "class=\"wide\"><table><thead><tr><th>Case</th><th class=\"text\">What is counted</th>"
        "<th>Figure</th><th>Bound</th><th></th></tr></thead><tbody>{}</tbody></table></div></details>",
        good < all ? " open" : "", escaped(part), good < all ? "bad" : "ok", good, all, rows);
  }
  return out + "</section>";
}

std::string leftOut(const ReportData& report) {
  if (report.leftOut.empty()) return {};
  std::string rows;
  for (const LeftOutFigures& l : report.leftOut)
    rows += fmt::format(
        "<tr><td class=\"text\">{}</td><td class=\"text\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
        escaped(spoken(l.what)), escaped(l.why), figure(l.count), figure(l.savedMilliseconds), figure(l.savedMb));
  return "<section><h2>Left out</h2><p class=\"lead\">Parts of the program that this scene does not need and so does "
         "not "
         "have, and parts of the input that are not shown.</p><div class=\"wide\"><table><thead><tr><th>What</th>"
         "<th class=\"text\">Why</th><th>How many</th><th>Saved<small>ms a frame</small></th>"
         "<th>Saved<small>MB</small></th></tr></thead><tbody>" +
         rows + "</tbody></table></div></section>";
}

std::string words(const ReportData& report) {
  std::string notes;
  for (const std::string& note : report.notes) notes += fmt::format("<li>{}</li>", escaped(note));
  return "<section><h2>What the words mean</h2><dl>"
         "<dt>Frame</dt><dd>Milliseconds from the frame's start until the graphics card has finished it. The median of "
         "all timed frames, with the interval that holds it with 95 % confidence (bootstrap).</dd>"
         "<dt>Faster than all off</dt><dd>Median frame of “everything off” divided by that of the configuration; the "
         "same "
         "views, drawn in turn.</dd>"
         "<dt>Perfect visibility</dt><dd>Only buildings with at least one visible pixel are drawn, in full detail: "
         "what "
         "the best possible culling would cost.</dd>"
         "<dt>Lost pixels</dt><dd>Pixels of a building that can be seen but was left out. Must be 0.</dd>"
         "<dt>Drawn ÷ visible</dt><dd>Buildings drawn for each building that can be seen; 1 is perfect.</dd>"
         "<dt>RMSE, PSNR</dt><dd>Root mean square difference from the reference over all pixels, and the same in "
         "decibels.</dd>"
         "<dt>FLIP</dt><dd>How large a difference an eye sees when flipping between picture and reference at arm's "
         "length: 0 none, 1 as different as can be (Andersson et al. 2020).</dd>"
         "<dt>Popping</dt><dd>The largest jump of FLIP from one frame to the next during a slow approach.</dd>"
         "<dt>Geometric</dt><dd>How far surfaces are drawn from where they belong, as the techniques themselves bound "
         "it.</dd></dl>" +
         (notes.empty() ? "" : "<h3>In this report</h3><ul>" + notes + "</ul>") + "</section>";
}

}  // namespace

std::string reportPage(const ReportData& report) {
  std::string out = fmt::format(
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><title>{} – Vicus report</title><style>{}</style></head><body>",
      escaped(report.scene), kPageStyle);
  out += header(report) + summary(report) + headlineTable(report) + curves(report) + pictures(report) + stages(report) +
         stability(report) + leftOut(report) + words(report);
  return out + fmt::format("<script>{}</script></body></html>\n", kPageScript);
}

}  // namespace vicus::report
