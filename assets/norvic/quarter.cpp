/// Based on: no one published method. High streets are cheapest ways from the market to where roads leave (as worn
/// paths are); lanes sprout from them along a cross field that follows walls, river and market, as in Chen et al. 2008,
/// "Interactive Procedural Street Modeling", but each sprout runs until it meets another street, so that there are no
/// dead ends and blocks split until they are too narrow to split. Houses are set along the streets one after another,
/// narrow fronts to the street, each tested exactly against all that stands already.
#include "assets/norvic/quarter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "assets/norvic/ground.hpp"
#include "assets/norvic/trees.hpp"
#include "city/random.hpp"

namespace vicus::assets::norvic {
namespace {

using city::Random;
using city::StreetKind;
using glm::dvec2;

constexpr double kTau = 6.283185307179586;
constexpr double kHouseSetback = 0.45;  // metres from the street's edge: room for a doorstep
constexpr double kWallLane = 13;        // metres from the town wall to the middle of the lane behind it
constexpr double kWallHalfWidth = 4.5;  // metres kept free on both sides of the wall's middle

dvec2 direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

dvec2 leftOf(dvec2 d) {
  return {-d.y, d.x};
}

/// Lays out one quarter, step by step.
class QuarterPlanner {
 public:
  QuarterPlanner(const QuarterBrief& brief, const Landscape& land, const HouseCatalogue& houses)
      : brief_(brief),
        land_(land),
        houses_(houses),
        random_(brief.seed),
        design_(designTown(brief, land)),
        net_(brief.min, brief.max),
        occupied_(brief.min, brief.max),
        streets_(brief.min, brief.max),
        walls_(brief.min, brief.max) {}

  QuarterPlan plan() {
    layMarket();
    layMonumentRings();
    layBridgesAndQuays();
    layHighStreets();
    layRingLane();
    growLanes();
    net_.prune(marketNode_);
    finishStreets();
    buildWall();
    placeSpots();
    placeChurches();
    placeHouses();
    plantTrees();
    return std::move(out_);
  }

 private:
  // --- the ground
  // -----------------------------------------------------------------------------------------------------

  /// How far inside the quarter's own ground p lies, metres; negative outside.
  double inside(dvec2 p) const {
    double room =
        std::min(std::min(p.x - brief_.min.x, p.y - brief_.min.y), std::min(brief_.max.x - p.x, brief_.max.y - p.y));
    const double own = glm::length(p - brief_.centre) - brief_.weight;
    for (const Neighbour& n : brief_.neighbours)
      room = std::min(room, 0.5 * (glm::length(p - n.centre) - n.weight - own));
    return room;
  }

  /// Radius of the town's edge in a direction from its centre, a little irregular.
  double edgeRadius(double angle) const {
    const double a = angle + brief_.heading;
    return brief_.radius * (1 + 0.05 * std::sin(3 * a) + 0.035 * std::sin(5 * a + 1.3) + 0.02 * std::sin(8 * a + 0.4));
  }
  double edgeRoom(dvec2 p) const {
    const dvec2 d = p - brief_.centre;
    return edgeRadius(std::atan2(d.y, d.x)) - glm::length(d);
  }

  bool dry(dvec2 p, double margin) const { return land_.riverDistance(p) > land_.dryDistance() + margin; }

  bool reserved(dvec2 p, double margin) const {
    if (out_.market.contains(p, margin)) return true;
    if (brief_.cathedral && design_.close.contains(p, margin)) return true;
    return brief_.castle && glm::length(p - design_.castle) < kMoundFoot + 16 + margin;
  }

  /// `margin` is kept from water and from what is reserved; a road between quarters passes over its ground's edge.
  bool streetMayPass(dvec2 p, double margin) const {
    return inside(p) > 3 && dry(p, 5 + margin) && !reserved(p, margin);
  }

  // --- streets
  // --------------------------------------------------------------------------------------------------------

  uint32_t newName(StreetKind kind) {
    static constexpr const char* kFirst[] = {
        "Baker",  "Cooper", "Tanner",      "Saddler",    "Weaver",   "Dyer", "Fuller", "Mercer", "Glover", "Potter",
        "Smith",  "Fisher", "Brewer",      "Chandler",   "Rose",     "Swan", "Bell",   "Angel",  "Elm",    "Willow",
        "Friars", "Bishop", "Saint Giles", "Saint Anne", "Magdalen", "King", "Timber", "Wool"};
    static constexpr const char* kLanes[] = {" Lane", " Row", " Alley", " Yard"};
    static constexpr const char* kStreets[] = {" Street", " Hill", " Way", " Street"};
    std::string name = kFirst[random_.below(std::size(kFirst))];
    name += kind == StreetKind::Lane   ? kLanes[random_.below(4)]
            : kind == StreetKind::Road ? " Road"
                                       : kStreets[random_.below(4)];
    out_.names.push_back(std::move(name));
    return static_cast<uint32_t>(out_.names.size() - 1);
  }

  StreetStyle style(StreetKind kind, double width) { return {kind, width, newName(kind)}; }

  void addRing(const PlanRect& rect, double out, const StreetStyle& s, bool fixed) {
    PlanRect r = rect;
    r.halfWidth += out, r.halfDepth += out;
    const auto c = r.corners();
    for (size_t i = 0; i < 4; ++i) {
      const dvec2 side[] = {c[i], c[(i + 1) % 4]};
      net_.add(side, s, fixed);
    }
  }

  void layMarket() {
    out_.market = {brief_.centre, direction(brief_.heading), 0.5 * brief_.market.x, 0.5 * brief_.market.y};
    out_.names.push_back("Market Place");
    addRing(out_.market, 3.5, {StreetKind::HighStreet, 7, 0}, true);
    marketNode_ = 0;
    out_.paved.push_back(out_.market);
  }

  void layMonumentRings() {
    if (brief_.cathedral) {
      out_.names.push_back("Cathedral Close");
      addRing(design_.close, 3, {StreetKind::Street, 6, static_cast<uint32_t>(out_.names.size() - 1)}, true);
    }
    if (brief_.castle) {
      std::vector<dvec2> ring;
      for (int i = 0; i <= 64; ++i) ring.push_back(design_.castle + direction(kTau * i / 64) * (kMoundFoot + 20));
      out_.names.push_back("Castle Ditch");
      net_.add(ring, {StreetKind::Street, 6, static_cast<uint32_t>(out_.names.size() - 1)});
    }
  }

  void addBridge(double x) {
    const dvec2 middle(x, land_.riverAt(x));
    const dvec2 across = leftOf(land_.riverDirection(x));
    const double deck = bridgeHalfLength(land_), approach = deck + 13;
    const uint32_t name = newName(StreetKind::HighStreet);
    const dvec2 south[] = {middle - across * approach, middle - across * deck};
    const dvec2 over[] = {middle - across * deck, middle + across * deck};
    const dvec2 north[] = {middle + across * deck, middle + across * approach};
    const auto first = net_.add(south, {StreetKind::HighStreet, 6, name}, true);
    net_.add(over, {StreetKind::Bridge, 6, name}, true);
    const auto last = net_.add(north, {StreetKind::HighStreet, 6, name}, true);
    bridgeEnds_.push_back(first.front());
    bridgeEnds_.push_back(last.back());
    out_.spots.push_back({SpotKind::Bridge, middle, std::atan2(across.y, across.x), 0});
  }

  void layBridgesAndQuays() {
    if (!land_.hasRiver() || brief_.bridges == 0) return;
    // The reach of the river that lies within the town.
    double from = 1e9, to = -1e9;
    for (double x = brief_.min.x; x < brief_.max.x; x += 6) {
      const dvec2 p(x, land_.riverAt(x));
      if (edgeRoom(p) > 60 && inside(p) > 60) from = std::min(from, x), to = std::max(to, x);
    }
    if (from > to) return;
    for (int i = 0; i < brief_.bridges; ++i)
      addBridge(glm::mix(from, to, (i + 0.5 + random_.uniform(-0.12, 0.12)) / brief_.bridges));
    if (!brief_.walled) return;
    for (const double side : {-1.0, 1.0}) {
      std::vector<dvec2> quay;
      for (double x = from - 80; x < to + 80; x += 6) {
        const dvec2 p =
            dvec2(x, land_.riverAt(x)) + leftOf(land_.riverDirection(x)) * (side * (land_.dryDistance() + 8));
        if (edgeRoom(p) > kWallLane - 4 && !reserved(p, 6)) quay.push_back(p);
      }
      out_.names.push_back(side < 0 ? "South Quay" : "North Quay");
      if (quay.size() > 4) net_.add(quay, {StreetKind::Street, 6.5, static_cast<uint32_t>(out_.names.size() - 1)});
    }
  }

  /// Cheapest ways over a grid of the quarter's ground.
  struct WayGrid {
    dvec2 min;
    glm::ivec2 size;
    std::vector<float> cost;  ///< for a metre within each cell; infinite where no street may pass
  };
  static constexpr double kWayCell = 12;

  WayGrid makeWayGrid() const {
    WayGrid g;
    g.min = brief_.min;
    g.size = glm::ivec2(glm::ceil((brief_.max - brief_.min) / kWayCell));
    g.cost.resize(static_cast<size_t>(g.size.x) * static_cast<size_t>(g.size.y));
    for (int y = 0; y < g.size.y; ++y)
      for (int x = 0; x < g.size.x; ++x) {
        const dvec2 p = g.min + (dvec2(x, y) + 0.5) * kWayCell;
        float& cost = g.cost[static_cast<size_t>(y * g.size.x + x)];
        cost = streetMayPass(p, 8)
                   ? static_cast<float>(1.3 + 0.6 * noise(p, 150, brief_.seed) + 0.4 * noise(p, 60, brief_.seed + 9))
                   : std::numeric_limits<float>::infinity();
      }
    return g;
  }

  /// The cheapest way from the streets that there are to `target`: those near the market by street are preferred.
  std::vector<dvec2> cheapestWay(const WayGrid& g, dvec2 target) const {
    const std::vector<double> byStreet = net_.distancesFrom(marketNode_);
    const size_t cells = g.cost.size();
    std::vector<float> best(cells, std::numeric_limits<float>::infinity());
    std::vector<uint32_t> from(cells, StreetNet::kNowhere);
    std::vector<uint32_t> source(cells, StreetNet::kNowhere);
    const auto cellOf = [&](dvec2 p) {
      const glm::ivec2 c = glm::clamp(glm::ivec2(glm::floor((p - g.min) / kWayCell)), glm::ivec2(0), g.size - 1);
      return static_cast<uint32_t>(c.y * g.size.x + c.x);
    };
    using Entry = std::pair<float, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (uint32_t n = 0; n < net_.nodes().size(); ++n) {
      if (!std::isfinite(byStreet[n]) || net_.nodes()[n].edges.empty()) continue;
      const StreetKind kind = net_.edges()[net_.nodes()[n].edges[0]].style.kind;
      if (kind == StreetKind::Bridge) continue;
      const uint32_t c = cellOf(net_.nodes()[n].position);
      const auto cost = static_cast<float>(0.72 * byStreet[n]);
      if (cost < best[c]) best[c] = cost, source[c] = n, open.push({cost, c});
    }
    const uint32_t goal = cellOf(target);
    while (!open.empty()) {
      const auto [cost, c] = open.top();
      open.pop();
      if (cost > best[c]) continue;
      if (c == goal) break;
      const int x = static_cast<int>(c) % g.size.x, y = static_cast<int>(c) / g.size.x;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = x + dx, ny = y + dy;
          if ((dx == 0 && dy == 0) || nx < 0 || ny < 0 || nx >= g.size.x || ny >= g.size.y) continue;
          const auto n = static_cast<uint32_t>(ny * g.size.x + nx);
          const float metre = n == goal ? 1.0f : g.cost[n];
          const auto to = cost + metre * static_cast<float>(kWayCell * (dx != 0 && dy != 0 ? 1.41421356 : 1.0));
          if (to < best[n]) best[n] = to, from[n] = c, source[n] = StreetNet::kNowhere, open.push({to, n});
        }
    }
    if (!std::isfinite(best[goal])) return {};
    std::vector<dvec2> way{target};
    uint32_t c = goal;
    int k = 0;
    while (from[c] != StreetNet::kNowhere && source[c] == StreetNet::kNowhere) {
      c = from[c];
      // Every fifth cell is a bend; the curve between them is smooth.
      if (++k % 5 == 0 && source[c] == StreetNet::kNowhere)
        way.push_back(g.min + (dvec2(c % static_cast<uint32_t>(g.size.x), c / static_cast<uint32_t>(g.size.x)) + 0.5) *
                                  kWayCell);
    }
    if (source[c] == StreetNet::kNowhere) return {};
    const dvec2 start = net_.nodes()[source[c]].position;
    if (way.size() > 1 && glm::length(way.back() - start) < 30) way.pop_back();
    way.push_back(start);
    std::reverse(way.begin(), way.end());
    return curveThrough(way, kStreetStep);
  }

  /// A street from the streets there are to `target`, high street within the town and road beyond.
  uint32_t leadTo(const WayGrid& grid, dvec2 target) {
    const std::vector<dvec2> way = cheapestWay(grid, target);
    if (way.size() < 2) return StreetNet::kNowhere;
    size_t leaves = 0;
    while (leaves < way.size() && edgeRoom(way[leaves]) > 0) ++leaves;
    std::vector<uint32_t> nodes;
    if (leaves > 1) nodes = net_.add(std::span(way).first(leaves), style(StreetKind::HighStreet, 6.6));
    if (leaves < way.size()) {
      const size_t start = leaves > 0 ? leaves - 1 : 0;
      if (way.size() - start > 1) nodes = net_.add(std::span(way).subspan(start), style(StreetKind::Road, 6));
    }
    return nodes.empty() ? StreetNet::kNowhere : nodes.back();
  }

  bool reached(uint32_t node) const { return std::isfinite(net_.distancesFrom(marketNode_)[node]); }

  void layHighStreets() {
    const WayGrid grid = makeWayGrid();
    if (brief_.cathedral) {
      // From the west front of the close.
      const dvec2 west = design_.close.centre - design_.close.axis * (design_.close.halfWidth + 3);
      const uint32_t node = net_.nearest(west, 12);
      if (node != StreetNet::kNowhere && !reached(node)) leadTo(grid, net_.nodes()[node].position);
    }
    if (brief_.castle) {
      const dvec2 toMarket = glm::normalize(brief_.centre - design_.castle);
      const uint32_t node = net_.nearest(design_.castle + toMarket * (kMoundFoot + 20), 12);
      if (node != StreetNet::kNowhere && !reached(node)) leadTo(grid, net_.nodes()[node].position);
    }
    for (const uint32_t end : bridgeEnds_)
      if (land_.side(net_.nodes()[end].position) == land_.side(brief_.centre)) leadTo(grid, net_.nodes()[end].position);
    for (const Exit& e : brief_.exits) {
      const uint32_t node = leadTo(grid, e.place);
      if (node == StreetNet::kNowhere) continue;
      net_.fix(node);
      exitNodes_.push_back({e.key, node});
    }
  }

  void layRingLane() {
    const double inset = brief_.walled ? kWallLane : 0;
    const StreetStyle s = style(StreetKind::Lane, brief_.walled ? 4.5 : 4);
    std::vector<dvec2> run;
    const auto flush = [&] {
      if (run.size() > 6) net_.add(run, s);
      run.clear();
    };
    constexpr int kPoints = 360;
    for (int i = 0; i <= kPoints; ++i) {
      const double angle = kTau * i / kPoints;
      const dvec2 p = brief_.centre + direction(angle) * (edgeRadius(angle) - inset);
      if (streetMayPass(p, 0))
        run.push_back(p);
      else
        flush();
    }
    flush();
  }

  /// The direction of streets at p: that of the four of the cross field there that is nearest to `along`.
  dvec2 fieldDirection(dvec2 p, dvec2 along) const {
    dvec2 sum(0);
    const auto add = [&](double angle, double weight) { sum += weight * direction(4 * angle); };
    const dvec2 out = p - brief_.centre;
    const double away = glm::length(out);
    add(brief_.heading + 0.5 * noise(p, 260, brief_.seed + 3), 0.35);
    add(brief_.heading, std::exp(-away * away / (110.0 * 110.0)));
    const double room = std::max(0.0, edgeRoom(p));
    add(std::atan2(out.y, out.x), 0.9 * std::exp(-room * room / (140.0 * 140.0)) + 0.15);
    if (land_.hasRiver()) {
      const double d = land_.riverDistance(p) - land_.dryDistance();
      const dvec2 along0 = land_.riverDirection(p.x);
      add(std::atan2(along0.y, along0.x), 1.2 * std::exp(-d * d / (130.0 * 130.0)));
    }
    if (brief_.castle) {
      const dvec2 from = p - design_.castle;
      const double d = glm::length(from) - kMoundFoot;
      add(std::atan2(from.y, from.x), 1.1 * std::exp(-d * d / (90.0 * 90.0)));
    }
    if (brief_.cathedral) {
      const double d = glm::length(p - design_.close.centre) - 60;
      add(std::atan2(design_.close.axis.y, design_.close.axis.x), std::exp(-d * d / (110.0 * 110.0)));
    }
    const double angle = std::atan2(sum.y, sum.x) / 4;
    dvec2 best = direction(angle);
    for (int k = 1; k < 4; ++k) {
      const dvec2 d = direction(angle + k * kTau / 4);
      if (glm::dot(d, along) > glm::dot(best, along)) best = d;
    }
    return best;
  }

  void growLanes() {
    std::vector<uint32_t> open;
    for (uint32_t n = 0; n < net_.nodes().size(); ++n) open.push_back(n);
    // An order that has nothing to do with that of making, so that no street's sprouts come evenly.
    std::sort(open.begin(), open.end(),
              [&](uint32_t a, uint32_t b) { return city::hash32(a, brief_.seed) < city::hash32(b, brief_.seed); });
    // The second time round closer to junctions, for the blocks that are still too large.
    for (const double ease : {1.0, 0.62}) {
      for (size_t i = 0; i < open.size(); ++i) {
        const uint32_t node = open[i];
        const auto before = static_cast<uint32_t>(net_.nodes().size());
        for (const double side : {-1.0, 1.0}) sprout(node, side, ease);
        for (auto n = before; n < net_.nodes().size(); ++n) open.push_back(n);
      }
    }
  }

  void sprout(uint32_t start, double side, double ease) {
    const StreetNet::Node& node = net_.nodes()[start];
    if (node.edges.size() != 2) return;
    const StreetKind kind = net_.edges()[node.edges[0]].style.kind;
    if (kind == StreetKind::Bridge) return;
    const dvec2 from = node.position;
    const double room = edgeRoom(from);
    if (room < 6) return;
    const double fraction = std::clamp(1 - room / brief_.radius, 0.0, 1.0);  // 0 at the market, 1 at the edge
    const double gap = ease * glm::mix(44.0, 70.0, fraction), clear = glm::mix(31.0, 47.0, fraction);
    bool crowded = false;
    net_.nodesWithin(from, gap, [&](uint32_t n) { crowded |= net_.nodes()[n].edges.size() > 2; });
    if (crowded) return;
    const dvec2 tangent = glm::normalize(net_.nodes()[net_.other(node.edges[0], start)].position -
                                         net_.nodes()[net_.other(node.edges[1], start)].position);
    dvec2 along = leftOf(tangent) * side;
    const dvec2 field = fieldDirection(from, along);
    along = glm::normalize(glm::dot(field, along) > 0.8 ? field : along);

    std::vector<dvec2> path{from};
    dvec2 p = from;
    constexpr double kLongest = 460;
    for (double run = kStreetStep; run < kLongest; run += kStreetStep) {
      const dvec2 wanted = fieldDirection(p, along);
      along = glm::normalize(along + 0.35 * wanted);
      p += along * kStreetStep;
      if (!streetMayPass(p, 1) || edgeRoom(p) < (brief_.walled ? kWallLane - 2 : -2)) return;
      path.push_back(p);
      if (run < 15) continue;
      // A street ahead ends this one; one beside it is too near.
      uint32_t end = StreetNet::kNowhere;
      double best = 1e9;
      bool tooNear = false;
      const double beside = std::min(clear, 0.72 * run);
      net_.nodesWithin(p, std::max(beside, 22.0), [&](uint32_t n) {
        const dvec2 to = net_.nodes()[n].position - p;
        const double d = glm::length(to), ahead = glm::dot(to, along);
        if (ahead > 0.75 * d) {
          const double wish = d - (net_.nodes()[n].edges.size() > 2 ? 7.0 : 0.0);
          if (d < 22 && wish < best) best = wish, end = n;
        } else if (std::abs(ahead) < 0.6 * d && d < beside) {
          tooNear = true;
        }
      });
      if (end != StreetNet::kNowhere) {
        const StreetKind endKind =
            net_.edges()[net_.nodes()[end].edges.empty() ? 0 : net_.nodes()[end].edges[0]].style.kind;
        if (run < 38 || endKind == StreetKind::Bridge || net_.nodes()[end].edges.empty()) return;
        path.push_back(net_.nodes()[end].position);
        const bool lane = run < 110 || random_.uniform() < 0.45;
        net_.add(path, lane ? style(StreetKind::Lane, random_.uniform(3.6, 4.4))
                            : style(StreetKind::Street, random_.uniform(5.0, 6.0)));
        return;
      }
      if (tooNear) return;
    }
  }

  void finishStreets() {
    out_.streets = net_.finish();
    for (const StreetNet::Node& n : net_.nodes()) out_.nodes.push_back(n.position);
    out_.exitNodes = exitNodes_;
    for (const StreetLine& line : out_.streets)
      for (size_t i = 1; i < line.points.size(); ++i)
        streets_.add({line.points[i - 1], line.points[i], 0.5 * line.style.width});
    // A bridge that no street leads to is not built.
    std::erase_if(out_.spots,
                  [&](const Spot& s) { return s.kind == SpotKind::Bridge && !streets_.anyNear(s.position, 1); });
    for (int i = 0; i < 96; ++i) {
      const double angle = kTau * i / 96;
      out_.outline.push_back(brief_.centre + direction(angle) * (edgeRadius(angle) - (brief_.walled ? 0 : -6)));
    }
  }

  // --- wall and monuments
  // ---------------------------------------------------------------------------------------------

  void buildWall() {
    if (!brief_.walled) return;
    constexpr int kPoints = 120;
    std::vector<dvec2> ring;
    for (int i = 0; i <= kPoints; ++i) {
      const double angle = kTau * i / kPoints;
      ring.push_back(brief_.centre + direction(angle) * edgeRadius(angle));
    }
    // A gate wherever a street passes; between gates and river a stretch of wall.
    for (size_t i = 1; i < ring.size(); ++i)
      for (const StreetLine& line : out_.streets)
        for (size_t k = 1; k < line.points.size(); ++k) {
          const double t = crossing(ring[i - 1], ring[i], line.points[k - 1], line.points[k]);
          if (t < 0) continue;
          const dvec2 at = glm::mix(ring[i - 1], ring[i], t);
          const dvec2 along = glm::normalize(line.points[k] - line.points[k - 1]);
          out_.gates.push_back({at, glm::dot(along, at - brief_.centre) < 0 ? -along : along, line.style.width});
        }
    std::vector<std::vector<dvec2>> open(1);
    for (const dvec2 p : resample(ring, 2)) {
      bool free = land_.riverDistance(p) > land_.riverHalfWidth() + 1;
      for (const Gate& g : out_.gates) free = free && glm::length(p - g.position) > 0.5 * g.width + 4.2;
      if (free)
        open.back().push_back(p);
      else if (!open.back().empty())
        open.emplace_back();
    }
    for (const auto& stretch : open) {
      if (lengthOf(stretch) < 4) continue;
      out_.walls.push_back({});
      for (const uint32_t i : simplify(stretch, 0.1)) out_.walls.back().push_back(stretch[i]);
      for (size_t i = 1; i < out_.walls.back().size(); ++i)
        walls_.add({out_.walls.back()[i - 1], out_.walls.back()[i], kWallHalfWidth});
    }
    for (const Gate& g : out_.gates) occupied_.add({g.position, g.outward, 8, 0.5 * g.width + 6});
  }

  void placeSpots() {
    occupied_.add(out_.market);
    out_.spots.push_back({SpotKind::MarketCross, brief_.centre, brief_.heading, 0});
    if (brief_.cathedral) {
      occupied_.add(design_.close);
      out_.grass.push_back(design_.close);
      PlanRect paving = design_.close;
      paving.centre -= paving.axis * (paving.halfWidth - 14);
      paving.halfWidth = 14;
      out_.paved.push_back(paving);
      out_.spots.push_back(
          {SpotKind::Cathedral, design_.close.centre, std::atan2(design_.close.axis.y, design_.close.axis.x), 0});
    }
    if (brief_.castle) {
      const double r = kMoundFoot + 15;
      for (const double turn : {0.0, kTau / 16, kTau / 8, 3 * kTau / 16}) {
        // Four rectangles, each a sixteenth further round, cover the mound's circle.
        const double half = r * std::cos(kTau / 16), breadth = r * std::sin(kTau / 16);
        occupied_.add({design_.castle, direction(turn), half, breadth + 0.5 * half});
      }
      const dvec2 toMarket = brief_.centre - design_.castle;
      out_.spots.push_back({SpotKind::Castle, design_.castle, std::atan2(toMarket.y, toMarket.x), 0});
    }
  }

  bool siteIsFree(const PlanRect& rect) const {
    for (const dvec2 c : rect.corners())
      if (inside(c) < 3 || !dry(c, 4) || (brief_.walled && std::abs(edgeRoom(c)) < 6)) return false;
    return !occupied_.anyOverlap(rect, 1) && !streets_.anyTouches(rect) && !walls_.anyTouches(rect);
  }

  void placeChurches() {
    struct Frontage {
      dvec2 at, along;
      double halfWidth;
      double order;
    };
    std::vector<Frontage> sites;
    for (const StreetLine& line : out_.streets) {
      if (line.style.kind == StreetKind::Bridge || line.style.kind == StreetKind::Road) continue;
      for (size_t k = 1; k < line.points.size(); ++k) {
        const dvec2 a = line.points[k - 1], b = line.points[k];
        if (glm::length(b - a) < 14) continue;
        const dvec2 middle = 0.5 * (a + b);
        sites.push_back({middle, glm::normalize(b - a), 0.5 * line.style.width, random_.uniform()});
      }
    }
    // The first church by the market, the others anywhere far enough from each other.
    std::stable_sort(sites.begin(), sites.end(),
                     [](const Frontage& a, const Frontage& b) { return a.order < b.order; });
    std::vector<dvec2> placed;
    if (brief_.cathedral) placed.push_back(design_.close.centre);
    for (int round = 0; round < brief_.churches; ++round) {
      const double apart = std::max(90.0, brief_.radius * 0.24);
      for (const Frontage& f : sites) {
        const double fromMarket = glm::length(f.at - brief_.centre);
        if (round == 0 && fromMarket > 110) continue;
        if (edgeRoom(f.at) < 30) continue;
        if (std::any_of(placed.begin(), placed.end(), [&](dvec2 p) { return glm::length(p - f.at) < apart; })) continue;
        bool done = false;
        for (const double side : {1.0, -1.0}) {
          const dvec2 into = leftOf(f.along) * side;
          PlanRect yard{f.at + into * (f.halfWidth + 1 + 13), f.along, 20, 13};
          if (!siteIsFree(yard)) continue;
          occupied_.add(yard);
          out_.grass.push_back(yard);
          // The tower stands at the western end.
          const dvec2 east = f.along.x >= 0 ? f.along : -f.along;
          out_.spots.push_back(
              {SpotKind::Church, yard.centre, std::atan2(east.y, east.x), static_cast<int>(random_.below(3))});
          placed.push_back(f.at);
          done = true;
          break;
        }
        if (done) break;
      }
    }
  }

  // --- houses
  // ---------------------------------------------------------------------------------------------------------

  struct Weight {
    HouseKind kind;
    double weight;
  };

  /// Which kinds of house stand at a place of the town.
  HouseKind chooseKind(dvec2 p, StreetKind street) {
    using enum HouseKind;
    static constexpr Weight kCore[] = {{JettiedTall, 5},    {TimberRow, 3}, {BrickRow, 4},
                                       {SteppedGable, 2.5}, {Jettied, 3},   {Merchant, 0.9},
                                       {Inn, 0.7},          {Workshop, 1},  {TowerHouse, 0.35}};
    static constexpr Weight kMiddle[] = {{Jettied, 4},       {TimberRow, 5}, {BrickRow, 2}, {Workshop, 2},
                                         {FlintHouse, 1.5},  {Cottage, 1},   {Hall, 0.4},   {SteppedGable, 0.6},
                                         {Almshouses, 0.25}, {Inn, 0.15}};
    static constexpr Weight kCraft[] = {{Workshop, 5},  {FlintHouse, 3},   {BrickRow, 2.5},
                                        {TimberRow, 2}, {Almshouses, 0.4}, {Warehouse, 0.4}};
    static constexpr Weight kPoor[] = {
        {Cottage, 6}, {TimberRow, 2}, {FlintHouse, 2}, {Workshop, 0.6}, {Almshouses, 0.3}};
    static constexpr Weight kRiver[] = {{Warehouse, 4},    {Merchant, 3},     {BrickRow, 2},
                                        {SteppedGable, 2}, {TowerHouse, 0.5}, {Inn, 0.4}};
    static constexpr Weight kEdge[] = {{Cottage, 5}, {FlintHouse, 4}, {Hall, 1.2},
                                       {Barn, 1.0},  {Dovecote, 0.3}, {Jettied, 0.8}};
    const double away = glm::length(p - brief_.centre) / brief_.radius;
    std::span<const Weight> weights = kMiddle;
    if (land_.riverDistance(p) < land_.dryDistance() + 26 && brief_.walled)
      weights = kRiver;
    else if (street == StreetKind::Road || away > 0.96)
      weights = kEdge;
    else if (away < 0.36 || (street == StreetKind::HighStreet && away < 0.7))
      weights = kCore;
    else if (street == StreetKind::Lane && away > 0.55)
      weights = kPoor;
    else if (noise(p, 240, brief_.seed + 17) > 0.25)
      weights = kCraft;
    double sum = 0;
    for (const Weight& w : weights) sum += w.weight;
    double at = random_.uniform(0, sum);
    for (const Weight& w : weights)
      if ((at -= w.weight) < 0) return w.kind;
    return weights.front().kind;
  }

  /// Metres free beside a house of this kind in a row.
  static double gapBeside(HouseKind kind) {
    switch (kind) {
      case HouseKind::TimberRow:
      case HouseKind::BrickRow:
      case HouseKind::SteppedGable:
      case HouseKind::Inn:
        return 0.02;
      case HouseKind::Workshop:
        return 0.05;
      case HouseKind::Cottage:
      case HouseKind::FlintHouse:
      case HouseKind::Hall:
      case HouseKind::Barn:
        return 1.2;
      default:
        return 0.12;
    }
  }

  bool footprintIsFree(const PlanRect& ground, const PlanRect& whole) const {
    const auto corners = ground.corners();
    for (size_t i = 0; i < 4; ++i) {
      const dvec2 c = corners[i], m = 0.5 * (corners[i] + corners[(i + 1) % 4]);
      if (inside(c) < 3 || !dry(c, 1) || !dry(m, 1)) return false;
    }
    return !occupied_.anyOverlap(whole, 0.01) && !streets_.anyTouches(ground, 1e-6) && !walls_.anyTouches(whole) &&
           groundIsGentle(corners);
  }

  /// The ground under a house, front left corner first, may fall or rise no more than its foundation takes up.
  bool groundIsGentle(const std::array<dvec2, 4>& corners) const {
    double height[4];
    for (size_t i = 0; i < 4; ++i) height[i] = land_.height(corners[i]);
    const double door = std::max(height[0], height[1]);
    return *std::min_element(height, height + 4) > door - 1.2 && *std::max_element(height, height + 4) < door + 1.2;
  }

  /// Sets houses along one side (the left) of a line.
  void lineWithHouses(std::span<const dvec2> points, const StreetStyle& street) {
    HouseKind last = HouseKind::TimberRow;
    bool any = false;
    for (size_t k = 1; k < points.size(); ++k) {
      const dvec2 a = points[k - 1], along = points[k] - points[k - 1];
      const double length = glm::length(along);
      if (length < 3) continue;
      const dvec2 t = along / length;
      double s = 0;
      while (s < length - 2.5) {
        const dvec2 here = a + t * s;
        const double away = glm::length(here - brief_.centre) / brief_.radius;
        const bool outside = edgeRoom(here) < 0;
        const double chance = outside                           ? 0.5 * std::max(0.0, 1 - (away - 1) / 0.55)
                              : street.kind == StreetKind::Lane ? glm::mix(0.94, 0.55, std::min(1.0, away))
                                                                : glm::mix(0.99, 0.80, std::min(1.0, away));
        if (random_.uniform() > chance) {
          s += random_.uniform(3, outside ? 22 : 9);
          any = false;
          continue;
        }
        HouseKind kind = chooseKind(here, street.kind);
        if (any && random_.uniform() < 0.3) kind = last;
        if (const double used = tryHouse({a, t, length}, s, street, kind,
                                         (k == 1 && s < 4) || (k + 1 == points.size() && s > length - 9));
            used > 0) {
          s += used;
          last = kind, any = true;
        } else {
          s += 1.5;
          any = false;
        }
      }
    }
  }

  /// A straight piece of a street's side.
  struct Front {
    dvec2 start, along;  ///< `along` is a unit vector; houses stand on its left
    double length;
  };

  /// Tries sizes of a kind at `s` metres along a front; metres used, 0 where none fits. At a `corner` a side shows.
  double tryHouse(const Front& front, double s, const StreetStyle& street, HouseKind kind, bool corner) {
    const std::vector<uint32_t>& sizes = houses_.byKind[static_cast<size_t>(kind)];
    const auto count = static_cast<uint32_t>(sizes.size());
    const uint32_t first = random_.below(count);
    const double gap = gapBeside(kind);
    // Where a side shows, one of those with windows there, if the kind has them.
    uint32_t tried = 0;
    for (uint32_t i = 0; i < 2 * count && tried < 3; ++i) {
      const uint32_t index = (first + i) % count;
      if (i < count && houses_.variants[sizes[index]].sideWindows != corner) continue;
      ++tried;
      const HouseVariant& v = houses_.variants[sizes[index]];
      const double width = static_cast<double>(v.width), depth = static_cast<double>(v.depth);
      const double side = static_cast<double>(v.sideReach);
      if (s + width > front.length + 0.25 * width) continue;
      const dvec2 t = front.along, into = leftOf(t);
      const double back = 0.5 * street.width + kHouseSetback;
      const dvec2 centre = front.start + t * (s + side + 0.5 * width) + into * (back + 0.5 * depth);
      const PlanRect ground{centre, t, 0.5 * width, 0.5 * depth};
      PlanRect whole = ground;
      const double reach = static_cast<double>(v.frontReach);
      whole.centre -= into * (0.5 * reach);
      whole.halfDepth += 0.5 * reach;
      whole.halfWidth += side;
      if (!footprintIsFree(ground, whole)) continue;
      occupied_.add(whole);
      Plot plot;
      plot.position = centre;
      plot.heading = static_cast<float>(std::atan2(t.y, t.x));
      plot.variant = sizes[index];
      plot.priority = static_cast<float>(glm::length(centre - brief_.centre) + random_.uniform(0, 40));
      plot.seed = random_.bits();
      out_.plots.push_back(plot);
      out_.trodden.push_back(troddenAbout(ground));
      const double garden = random_.uniform(9, 20);
      out_.gardens.push_back({centre + into * (0.5 * depth + 0.5 * garden), t, 0.5 * width + 0.3, 0.5 * garden});
      return width + 2 * side + gap + (random_.uniform() < 0.06 ? 1.3 : 0.0);
    }
    return 0;
  }

  void placeHouses() {
    // From the market outward, so that the best fronts go first.
    std::vector<std::pair<double, size_t>> order;
    for (size_t i = 0; i < out_.streets.size(); ++i) {
      const StreetLine& line = out_.streets[i];
      if (line.style.kind == StreetKind::Bridge) continue;
      const dvec2 middle = line.points[line.points.size() / 2];
      const double rank = line.style.kind == StreetKind::HighStreet ? 0.0
                          : line.style.kind == StreetKind::Street   ? 100.0
                                                                    : 200.0;
      order.emplace_back(glm::length(middle - brief_.centre) + rank, i);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [rank, i] : order) {
      const StreetLine& line = out_.streets[i];
      lineWithHouses(line.points, line.style);
      std::vector<dvec2> reversed(line.points.rbegin(), line.points.rend());
      lineWithHouses(reversed, line.style);
    }
    std::stable_sort(out_.plots.begin(), out_.plots.end(),
                     [](const Plot& a, const Plot& b) { return a.priority < b.priority; });
  }

  // --- trees
  // ----------------------------------------------------------------------------------------------------------

  bool treeMayStand(dvec2 p, double margin) const {
    return inside(p) > 2 && dry(p, -2) && !occupied_.anyContains(p, margin) && !streets_.anyNear(p, 0.8) &&
           !walls_.anyNear(p, 0.5);
  }

  void plantTrees() {
    const auto plant = [&](dvec2 p, uint8_t kind, double margin) {
      if (treeMayStand(p, margin)) out_.trees.push_back({p, kind, random_.bits()});
    };
    for (const PlanRect& g : out_.gardens)
      if (random_.uniform() < 0.4)
        plant(g.centre + g.axis * random_.uniform(-1, 1) * g.halfWidth +
                  g.across() * random_.uniform(-0.2, 1) * g.halfDepth,
              static_cast<uint8_t>(random_.uniform() < 0.7 ? TreeKind::Apple : TreeKind::Oak), 2.2);
    plantFields();
    plantOrchards();
    // In churchyards and the close, inside what is kept free of houses.
    for (const PlanRect& g : out_.grass) {
      const bool close = g.halfWidth > 30;
      const int count = close ? 26 : 4;
      for (int i = 0; i < count; ++i) {
        const double side = random_.uniform() < 0.5 ? -1 : 1;
        const double edge = close ? random_.uniform(0.84, 0.95) : 0.86;
        const dvec2 p =
            g.centre + g.axis * (random_.uniform(-0.95, 0.95) * g.halfWidth) + g.across() * (side * edge * g.halfDepth);
        out_.trees.push_back({p, static_cast<uint8_t>(i % 3 == 0 ? TreeKind::Poplar : TreeKind::Oak), random_.bits()});
      }
    }
  }

  /// Rows of apple trees where a block has much ground behind its houses' gardens.
  void plantOrchards() {
    constexpr double kRow = 8;
    const dvec2 axis = direction(brief_.heading), across = leftOf(axis);
    const int reach = static_cast<int>(brief_.radius / kRow);
    for (int i = -reach; i <= reach; ++i)
      for (int k = -reach; k <= reach; ++k) {
        const dvec2 p = brief_.centre + axis * (i * kRow) + across * (k * kRow);
        if (edgeRoom(p) < 20 || noise(p, 130, brief_.seed + 23) < -0.15 || random_.uniform() < 0.25) continue;
        if (!dry(p, 6) || reserved(p, 4) || occupied_.anyContains(p, 13) || streets_.anyNear(p, 9)) continue;
        const dvec2 off(random_.uniform(-1, 1), random_.uniform(-1, 1));
        out_.trees.push_back({p + off, static_cast<uint8_t>(TreeKind::Apple), random_.bits()});
      }
  }

  /// Hedges and trees along the fields' edges, a few woods, and willows by the water.
  void plantFields() {
    constexpr double kStep = 15;
    const auto kindIn = [&](bool wood) {
      const double u = random_.uniform();
      return static_cast<uint8_t>(wood ? (u < 0.8 ? TreeKind::Oak : TreeKind::Poplar)
                                       : (u < 0.45  ? TreeKind::Bush
                                          : u < 0.9 ? TreeKind::Oak
                                                    : TreeKind::Poplar));
    };
    for (double y = brief_.min.y; y < brief_.max.y; y += kStep)
      for (double x = brief_.min.x; x < brief_.max.x; x += kStep) {
        const dvec2 p = dvec2(x, y) + dvec2(random_.uniform(), random_.uniform()) * kStep;
        if (inside(p) < 4) continue;
        const double bank = land_.riverDistance(p) - land_.dryDistance();
        if (bank > -1 && bank < 5 && (!brief_.walled || edgeRoom(p) < 0)) {
          if (random_.uniform() < 0.4 && treeMayStand(p, 2))
            out_.trees.push_back({p, static_cast<uint8_t>(TreeKind::Willow), random_.bits()});
          continue;
        }
        if (edgeRoom(p) > -25) continue;
        const bool wood = noise(p, 210, brief_.fieldSeed + 5) > 0.55;
        const Parcel parcel = parcelAt(p, brief_.fieldSeed);
        const bool hedge = parcel.toEdge < 2.2 && (parcel.number & 3U) != 0;
        if ((wood || hedge) && treeMayStand(p, 3)) out_.trees.push_back({p, kindIn(wood), random_.bits()});
      }
  }

  const QuarterBrief& brief_;
  const Landscape& land_;
  const HouseCatalogue& houses_;
  Random random_;
  TownDesign design_;
  QuarterPlan out_;
  StreetNet net_;
  RectGrid occupied_;
  SegmentGrid streets_, walls_;
  uint32_t marketNode_ = 0;
  std::vector<uint32_t> bridgeEnds_;
  std::vector<std::pair<uint32_t, uint32_t>> exitNodes_;
};

}  // namespace

TownDesign designTown(const QuarterBrief& brief, const Landscape& land) {
  TownDesign d;
  // The castle above the market's eastern end, the cathedral further east where the ground falls to the river.
  d.castle = brief.centre + dvec2(0.30, -0.02) * brief.radius;
  const double x = brief.centre.x + 0.62 * brief.radius;
  double y = brief.centre.y + 0.3 * brief.radius;
  if (land.hasRiver()) y = std::min(y, land.riverAt(x) - land.dryDistance() - 90);
  d.close = {{x, y}, direction(0.06), 76, 46};
  return d;
}

QuarterPlan planQuarter(const QuarterBrief& brief, const Landscape& land, const HouseCatalogue& houses) {
  return QuarterPlanner(brief, land, houses).plan();
}

double bridgeHalfLength(const Landscape& land) {
  return land.dryDistance() + 1;
}

double deckHeight(const Landscape& land, double distance) {
  const double t = std::min(1.0, std::abs(distance) / bridgeHalfLength(land));
  return Landscape::kPlainHeight + 1.7 * (1 - t * t);
}

}  // namespace vicus::assets::norvic
