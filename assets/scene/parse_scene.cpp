// TOML through toml++; what the keys mean is said in docs/scene.md and, for editors, in docs/scene.schema.json.
#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "assets/scene/scene_description.hpp"
#include "assets/scene/suggest.hpp"
#include "light/sun_position.hpp"

namespace vicus::assets {
namespace {

std::string placeOf(const toml::source_region& region) {
  return "line " + std::to_string(region.begin.line) + ", column " + std::to_string(region.begin.column);
}

std::string kindOf(const toml::node& node) {
  std::ostringstream text;
  text << node.type();
  return text.str();
}

double radians(double degrees) {
  return degrees * M_PI / 180;
}

/// The errors of one description.
class Errors {
 public:
  Errors(const std::string& file, city::Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}
  void say(const toml::node& at, const std::string& message) { say(at.source(), message); }
  void say(const toml::source_region& at, const std::string& message) {
    ++count_;
    constexpr size_t kMost = 100;
    if (count_ <= kMost) diagnostics_.error(file_, placeOf(at), message);
  }
  size_t count() const { return count_; }

 private:
  const std::string& file_;
  city::Diagnostics& diagnostics_;
  size_t count_ = 0;
};

/// One table of the description. Each question names a key that the table may have; `finish` complains about all
/// others.
class Table {
 public:
  Table(const toml::table& table, std::string name, Errors& errors)
      : table_(table), name_(std::move(name)), errors_(errors) {}

  const toml::node* find(const char* key) {
    known_.emplace_back(key);
    return table_.get(key);
  }
  const toml::node* need(const char* key) {
    const toml::node* node = find(key);
    if (!node) errors_.say(table_, name_ + " lacks " + key);
    return node;
  }
  void text(const char* key, std::string& out) { text(find(key), key, out); }
  void needText(const char* key, std::string& out) { text(need(key), key, out); }
  void number(const char* key, double& out, double least = -INFINITY, double most = INFINITY) {
    if (const auto value = numberAt(find(key), key, least, most)) out = *value;
  }
  std::optional<double> number(const char* key, double least = -INFINITY, double most = INFINITY) {
    return numberAt(find(key), key, least, most);
  }
  void degrees(const char* key, double& out) {
    if (const auto value = numberAt(find(key), key, -3600, 3600)) out = radians(*value);
  }
  void flag(const char* key, bool& out) {
    const toml::node* node = find(key);
    if (!node) return;
    if (const auto value = node->value_exact<bool>())
      out = *value;
    else
      wrong(*node, key, "true or false");
  }
  void texts(const char* key, std::vector<std::string>& out) {
    const toml::node* node = find(key);
    if (!node) return;
    if (const auto one = node->value_exact<std::string>()) {
      out.push_back(*one);
      return;
    }
    const toml::array* list = node->as_array();
    if (!list) return wrong(*node, key, "a text or a list of texts");
    for (const toml::node& entry : *list)
      if (const auto value = entry.value_exact<std::string>())
        out.push_back(*value);
      else
        wrong(entry, key, "a list of texts");
  }
  /// Numbers of a list of fixed length.
  bool numbers(const char* key, double* out, size_t count) {
    const toml::node* node = find(key);
    if (!node) return false;
    const toml::array* list = node->as_array();
    bool good = list && list->size() == count;
    for (size_t i = 0; good && i < count; ++i) {
      const auto value = list->get(i)->value<double>();
      good = value && std::isfinite(*value) && !list->get(i)->is_boolean();
      if (good) out[i] = *value;
    }
    if (!good) wrong(*node, key, "a list of " + std::to_string(count) + " numbers");
    return good;
  }
  /// Calls `read` for each table of a list of tables.
  template <typename Read>
  void tables(const char* key, const Read& read) {
    const toml::node* node = find(key);
    if (!node) return;
    const toml::array* list = node->as_array();
    if (!list) return wrong(*node, key, std::string("a list of tables: [[") + key + "]]");
    for (const toml::node& entry : *list)
      if (const toml::table* inner = entry.as_table()) {
        Table table(*inner, std::string("this entry of ") + key, errors_);
        read(table);
        table.finish();
      } else {
        wrong(entry, key, "a table");
      }
  }
  template <typename Read>
  void table(const char* key, const Read& read) {
    const toml::node* node = find(key);
    if (!node) return;
    const toml::table* inner = node->as_table();
    if (!inner) return wrong(*node, key, std::string("a table: [") + key + "]");
    Table table(*inner, std::string("[") + key + "]", errors_);
    read(table);
    table.finish();
  }
  void finish() {
    for (auto&& [key, node] : table_) {
      if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
      const std::string meant = nearest(key.str(), known_);
      errors_.say(key.source(), "the key " + std::string(key.str().substr(0, 60)) + " is not known in " + name_ +
                                    (meant.empty() ? "" : "; did you mean " + meant + "?"));
    }
  }
  void wrong(const toml::node& node, const std::string& key, const std::string& wanted) {
    errors_.say(node, key + " is " + wanted + ", not " + kindOf(node));
  }
  const toml::table& raw() const { return table_; }
  Errors& errors() { return errors_; }
  const std::string& name() const { return name_; }

 private:
  void text(const toml::node* node, const char* key, std::string& out) {
    if (!node) return;
    if (const auto value = node->value_exact<std::string>())
      out = *value;
    else
      wrong(*node, key, "a text in quotes");
  }
  std::optional<double> numberAt(const toml::node* node, const char* key, double least, double most) {
    if (!node) return std::nullopt;
    const auto value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) {
      wrong(*node, key, "a number");
      return std::nullopt;
    }
    if (!(*value >= least && *value <= most)) {
      std::ostringstream range;
      range << key << " is " << *value << "; it goes from " << least << " to " << most;
      errors_.say(*node, range.str());
      return std::nullopt;
    }
    return value;
  }

  const toml::table& table_;
  std::string name_;
  Errors& errors_;
  std::vector<std::string> known_;
};

void oneOf(Table& table, const char* key, std::string& out, const std::vector<std::string>& choices) {
  std::string value;
  const toml::node* node = table.find(key);
  if (!node) return;
  if (const auto text = node->value_exact<std::string>()) value = *text;
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) {
    out = value;
    return;
  }
  std::string all;
  for (const std::string& c : choices) all += (all.empty() ? "" : ", ") + c;
  const std::string meant = nearest(value, choices);
  table.errors().say(*node,
                     std::string(key) + " is one of " + all + (meant.empty() ? "" : "; did you mean " + meant + "?"));
}

void readFinish(Table& table, const char* key, std::optional<Finish>& out) {
  std::string name;
  oneOf(table, key, name, finishNames());
  if (!name.empty()) out = finishNamed(name);
}

/// Which parameters there are only the rules know: `checkStyles` asks them.
void readParameters(Table& t, StyleRule& rule) {
  for (auto&& [key, node] : t.raw()) {
    StyleParameter& p = rule.parameters.emplace_back();
    p.name = key.str(), p.place = placeOf(key.source());
    if (const auto value = t.number(p.name.c_str())) p.value = *value;
  }
  if (rule.rules.empty()) t.errors().say(t.raw(), "parameters belong to rules: name these, too");
}

void readStyles(Table& table, std::vector<StyleRule>& out) {
  table.tables("styles", [&](Table& t) {
    StyleRule& rule = out.emplace_back();
    t.tables("where", [&](Table& w) {
      StyleCondition& c = rule.where.emplace_back();
      w.needText("attribute", c.attribute);
      std::string text;
      if (w.find("equals")) w.text("equals", text), c.equals = text;
      text.clear();
      if (w.find("contains")) w.text("contains", text), c.contains = text;
      c.atLeast = w.number("at_least");
      c.below = w.number("below");
    });
    t.text("rules", rule.rules);
    t.table("parameters", [&](Table& p) { readParameters(p, rule); });
    readFinish(t, "facade", rule.facade);
    readFinish(t, "walls", rule.plain);
    readFinish(t, "roof", rule.roof);
  });
}

void readPlace(Table& t, ScenePlace& place) {
  double xy[2] = {0, 0};
  if (t.numbers("position", xy, 2)) place.position = {xy[0], xy[1]};
  const bool hasPosition = t.raw().contains("position"), hasDegrees = t.raw().contains("lonlat");
  if (t.numbers("lonlat", xy, 2)) {
    place.position = {xy[0], xy[1]}, place.degrees = true;
    if (!(std::abs(xy[0]) <= 180 && std::abs(xy[1]) <= 90))
      t.errors().say(*t.find("lonlat"), "lonlat is longitude (-180 to 180), then latitude (-90 to 90)");
  }
  if (hasPosition == hasDegrees)
    t.errors().say(t.raw(), t.name() + (hasPosition ? " has both position and lonlat: one is enough"
                                                    : " lacks its place: position = [x, y] in the scene's CRS, or "
                                                      "lonlat = [longitude, latitude]"));
  place.altitude = t.number("altitude", -12000, 20000);
  t.number("above_ground", place.aboveGround, -1000, 20000);
}

void readKey(Table& t, SceneKey& key) {
  key.place.aboveGround = 1.65;  // a visitor's eye
  readPlace(t, key.place);
  t.degrees("heading", key.heading);
  t.degrees("pitch", key.pitch);
}

void readViews(Table& root, SceneDescription& scene) {
  root.tables("views", [&](Table& t) {
    SceneTour& view = scene.tours.emplace_back();
    t.needText("name", view.name);
    readKey(t, view.keys.emplace_back());
  });
  root.tables("tours", [&](Table& t) {
    SceneTour& tour = scene.tours.emplace_back();
    t.needText("name", tour.name);
    t.flag("jumps", tour.jumps);
    double last = -INFINITY;
    t.tables("keys", [&](Table& k) {
      SceneKey& key = tour.keys.emplace_back();
      k.number("time", key.time, 0, 1e6);
      if (!(key.time > last)) k.errors().say(k.raw(), "the keys' times increase");
      last = key.time;
      readKey(k, key);
    });
    if (tour.keys.empty()) t.errors().say(t.raw(), "a tour has keys: [[tours.keys]]");
  });
}

/// Knobs may be written "roam.pixel_error" = 2 or as a table roam.pixel_error = 2.
void readKnobs(const toml::table& table, const std::string& prefix, int depth, std::vector<SceneSetting>& out,
               Errors& errors) {
  for (auto&& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    constexpr int kDeepest = 3;
    if (const toml::table* inner = node.as_table(); inner && depth < kDeepest) {
      readKnobs(*inner, name + ".", depth + 1, out, errors);
      continue;
    }
    std::ostringstream value;
    if (node.is_boolean())
      value << (node.value_or(false) ? "on" : "off");
    else if (node.is_number())
      value << node.value_or(0.0);
    else if (node.is_string())
      value << node.value_or(std::string());
    else
      errors.say(node, "a knob is a number, or true or false, not " + kindOf(node));
    out.push_back({name + "=" + value.str(), placeOf(key.source())});
  }
}

/// The sun by date: TOML's own dates and times.
void readMoment(Table& t, SceneEnvironment& environment) {
  const toml::node *date = t.find("date"), *time = t.find("time");
  double xy[2] = {0, 0};
  if (t.numbers("lonlat", xy, 2)) {
    environment.lonlat = {radians(xy[0]), radians(xy[1])};
    if (!(std::abs(xy[0]) <= 180 && std::abs(xy[1]) <= 90))
      t.errors().say(*t.find("lonlat"), "lonlat is longitude (-180 to 180), then latitude (-90 to 90)");
  }
  environment.utcOffset = t.number("utc_offset", -14, 14);
  if (date && !date->as_date()) t.wrong(*date, "date", "a date like 1390-08-24, without quotes");
  if (time && !time->as_time()) t.wrong(*time, "time", "a time like 14:30:00, without quotes");
  if (!date && !time) return;
  if (environment.sunAzimuth || environment.sunElevation)
    t.errors().say(date ? *date : *time, "the sun stands by its angles or by a date and time: one is enough");
  if (!date) return t.errors().say(*time, "a time needs a date");
  const toml::date day = date->value<toml::date>().value_or(toml::date{});
  const toml::time hour = time ? time->value<toml::time>().value_or(toml::time{}) : toml::time{12, 0};
  environment.days =
      light::daysOf(day.year, day.month, day.day) + (hour.hour + (hour.minute + hour.second / 60.0) / 60) / 24;
}

void readRoot(Table& root, SceneDescription& scene) {
  root.text("name", scene.name);
  root.text("crs", scene.crs);
  root.text("folder", scene.folder);
  root.table("terrain", [&](Table& t) {
    t.texts("files", scene.terrain.files);
    t.text("crs", scene.terrain.crs);
    oneOf(t, "unit", scene.terrain.unit, {"m", "dm", "cm", "ft", "us-ft"});
  });
  root.tables("sources", [&](Table& t) {
    SceneSource& s = scene.sources.emplace_back();
    t.needText("file", s.file);
    t.text("crs", s.crs);
    t.text("height_column", s.heightColumn);
    t.text("ground_column", s.groundColumn);
    t.text("layer", s.layer);
    t.number("lod", s.lod, 0, 10);
    t.number("default_height", s.defaultHeight, 0.5, 1000);
    bool colours = false;
    if (t.find("colours")) t.flag("colours", colours), s.colours = colours;
    readStyles(t, s.styles);
  });
  readStyles(root, scene.styles);
  root.tables("monuments", [&](Table& t) {
    SceneMonument& m = scene.monuments.emplace_back();
    t.text("name", m.name);
    t.needText("file", m.file);
    readPlace(t, m.place);
    t.degrees("heading", m.heading);
    t.number("scale", m.scale, 1e-6, 1e6);
    m.height = t.number("height", 1e-3, 1e4);
    oneOf(t, "up", m.up, {"y", "z"});
  });
  readViews(root, scene);
  if (const toml::node* knobs = root.find("knobs")) {
    if (const toml::table* table = knobs->as_table())
      readKnobs(*table, "", 0, scene.knobs, root.errors());
    else
      root.wrong(*knobs, "knobs", "a table: [knobs]");
  }
  root.table("avatars", [&](Table& t) {
    SceneAvatars& a = scene.avatars;
    double count = 0, seed = 1;
    t.number("count", count, 0, 100000);
    t.number("seed", seed, 0, 4294967295.0);
    t.number("density", a.density, 0, 10000);
    a.count = static_cast<uint32_t>(count), a.seed = static_cast<uint32_t>(seed);
    t.flag("on", a.on);
    oneOf(t, "dress", a.dress, {"medieval", "modern"});
    t.texts("characters", a.characters);
    t.texts("motions", a.motions);
  });
  root.table("environment", [&](Table& t) {
    if (const auto v = t.number("sun_azimuth", -360, 360)) scene.environment.sunAzimuth = radians(*v);
    if (const auto v = t.number("sun_elevation", -90, 90)) scene.environment.sunElevation = radians(*v);
    scene.environment.hazeDistance = t.number("haze_distance", 10, 1e6);
    readMoment(t, scene.environment);
  });
}

}  // namespace

std::optional<SceneDescription> parseScene(std::string_view text, const std::string& file,
                                           city::Diagnostics& diagnostics) {
  SceneDescription scene;
  scene.file = file;
  Errors errors(file, diagnostics);
  try {
    const toml::table table = toml::parse(text, file);
    Table root(table, "a scene description", errors);
    readRoot(root, scene);
    root.finish();
  } catch (const toml::parse_error& e) {
    diagnostics.error(file, placeOf(e.source()), std::string(e.description()));
    return std::nullopt;
  }
  if (errors.count() > 0) return std::nullopt;
  const std::filesystem::path own = std::filesystem::path(file).parent_path();
  scene.folder = (own / scene.folder).lexically_normal().string();
  return scene;
}

}  // namespace vicus::assets
