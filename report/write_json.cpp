#include "report/write_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace vicus::report {
namespace {

using Json = nlohmann::ordered_json;

// Each struct names its fields once, in `fields`; a Writer or a Reader visits them.

class Writer {
 public:
  template <typename T>
  void operator()(const char* key, const T& value) {
    object[key] = write(value);
  }
  /// The fields of `value` among this object's own.
  template <typename T>
  void inlined(const T& value) {
    fields(*this, const_cast<T&>(value));
  }
  Json object = Json::object();

  static Json write(const std::string& v) { return v; }
  static Json write(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }
  template <typename T>
  static Json write(const std::optional<T>& v) {
    return v ? write(*v) : Json(nullptr);
  }
  template <typename T>
  requires std::is_integral_v<T>
  static Json write(T v) { return v; }
  template <typename T, size_t N>
  static Json write(const std::array<T, N>& v) {
    return v;
  }
  template <typename T>
  static Json write(const std::vector<T>& v) {
    Json list = Json::array();
    for (const T& item : v) list.push_back(write(item));
    return list;
  }
  template <typename T>
  static Json write(const Named<T>& v) {
    Json map = Json::object();
    for (const auto& [name, value] : v) map[name] = write(value);
    return map;
  }
  template <typename T>
  requires std::is_class_v<T>
  static Json write(const T& v) {
    Writer writer;
    writer.inlined(v);
    return std::move(writer.object);
  }
};

class Reader {
 public:
  explicit Reader(const Json& from) : object(from) {}
  template <typename T>
  void operator()(const char* key, T& value) const {
    if (const auto found = object.find(key); found != object.end()) read(*found, value);
  }
  template <typename T>
  void inlined(T& value) const {
    fields(*this, value);
  }
  const Json& object;

  static void read(const Json& j, std::string& v) { v = j.get<std::string>(); }
  static void read(const Json& j, double& v) { v = j.is_null() ? NAN : j.get<double>(); }
  template <typename T>
  static void read(const Json& j, std::optional<T>& v) {
    v.reset();
    if (!j.is_null()) read(j, v.emplace());
  }
  template <typename T>
  requires std::is_integral_v<T>
  static void read(const Json& j, T& v) { v = j.get<T>(); }
  template <typename T, size_t N>
  static void read(const Json& j, std::array<T, N>& v) {
    v = j.get<std::array<T, N>>();
  }
  template <typename T>
  static void read(const Json& j, std::vector<T>& v) {
    v.clear();
    for (const Json& item : j) read(item, v.emplace_back());
  }
  template <typename T>
  static void read(const Json& j, Named<T>& v) {
    v.clear();
    for (const auto& [name, value] : j.items()) read(value, v.emplace_back(name, T{}).second);
  }
  template <typename T>
  requires std::is_class_v<T>
  static void read(const Json& j, T& v) {
    if (!j.is_object()) throw Json::type_error::create(302, "an object is missing", &j);
    Reader(j).inlined(v);
  }
};

template <typename Visitor>
void fields(Visitor& visit, Estimate& e) {
  visit("value", e.value), visit("low", e.low), visit("high", e.high);
}
template <typename Visitor>
void fields(Visitor& visit, viewer::Percentiles& p) {
  visit("median", p.median), visit("p95", p.p95), visit("p99", p.p99), visit("max", p.max);
}
template <typename Visitor>
void fields(Visitor& visit, viewer::MeanMax& m) {
  visit("mean", m.mean), visit("max", m.max);
}
template <typename Visitor>
void fields(Visitor& visit, FeatureFigures& f) {
  visit("on", f.on), visit("why", f.why);
}
template <typename Visitor>
void fields(Visitor& visit, MemoryFigures& m) {
  visit("peak_resident", m.peakResidentMb), visit("gpu", m.gpuMb);
}
template <typename Visitor>
void fields(Visitor& visit, ErrorFigures& e) {
  visit("falsely_culled_pixels", e.falselyCulledPixels), visit("lost_items", e.lostItems);
  visit("drawn_over_visible", e.drawnOverVisible);
  visit("rmse", e.rmse), visit("psnr", e.psnr), visit("ssim", e.ssim), visit("flip", e.flip);
  visit("popping", e.popping), visit("geometric_px", e.geometricPixels), visit("shift_px", e.shift);
}
/// "run_time_ms": the frame as `walk --json` has it, with its median's interval, and the stages.
struct RunTime {
  viewer::Percentiles& frame;
  std::optional<viewer::Percentiles>& gpu;
  Estimate& median;
  Named<viewer::Percentiles>& stages;
  Named<double>& leastStages;
};
template <typename Visitor>
void fields(Visitor& visit, RunTime& t) {
  visit("frame", t.frame), visit("gpu", t.gpu), visit("frame_median", t.median), visit("stages", t.stages);
  visit("least_stages", t.leastStages);
}
template <typename Visitor>
void fields(Visitor& visit, RunFigures& r) {
  visit("name", r.name), visit("path", r.path), visit("frames", r.frames);
  visit("knobs", r.knobs), visit("features", r.features);
  RunTime time{r.frame, r.gpu, r.frameMedian, r.stages, r.leastStages};
  visit("run_time_ms", time);
  visit("counts", r.counts), visit("memory_mb", r.memory), visit("error", r.error);
}
template <typename Visitor>
void fields(Visitor& visit, Speedup& s) {
  visit("run", s.run), visit("path", s.path), visit("over", s.over), visit("ratio", s.ratio);
}
template <typename Visitor>
void fields(Visitor& visit, CurvePoint& p) {
  visit("value", p.value), visit("default", p.isDefault), visit("ms", p.milliseconds), visit("error", p.error);
}
template <typename Visitor>
void fields(Visitor& visit, Curve& c) {
  visit("technique", c.technique), visit("knob", c.knob), visit("unit", c.unit), visit("path", c.path);
  visit("points", c.points);
}
template <typename Visitor>
void fields(Visitor& visit, city::StabilityRow& s) {
  visit("part", s.part), visit("case", s.caseName), visit("what", s.what);
  visit("figure", s.figure), visit("bound", s.bound), visit("ok", s.ok);
}
template <typename Visitor>
void fields(Visitor& visit, LeftOutFigures& l) {
  visit("what", l.what), visit("why", l.why), visit("count", l.count);
  visit("saved_ms", l.savedMilliseconds), visit("saved_mb", l.savedMb);
}
template <typename Visitor>
void fields(Visitor& visit, ReportData& r) {
  visit("scene", r.scene), visit("renderer", r.renderer), visit("size", r.size);
  visit("quick", r.quick), visit("complete", r.complete), visit("seconds", r.seconds), visit("notes", r.notes);
  visit("findings", r.findings), visit("runs", r.runs), visit("speedups", r.speedups), visit("curves", r.curves);
  visit("stability", r.stability), visit("left_out", r.leftOut);
}

}  // namespace

std::string reportJson(const ReportData& report) {
  Json json = Writer::write(report);
  // Each run alone is what `walk --json` writes, so it repeats what all share.
  for (Json& run : json["runs"]) {
    run["scene"] = report.scene;
    run["renderer"] = report.renderer;
    run["size"] = report.size;
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<ReportData> parseReport(const std::string& text, std::string& error) {
  try {
    ReportData report;
    Reader::read(Json::parse(text), report);
    return report;
  } catch (const Json::exception& problem) {
    error = problem.what();
    return std::nullopt;
  }
}

}  // namespace vicus::report
