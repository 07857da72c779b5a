#include "avatars/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "city/random.hpp"

namespace vicus::avatars {

using city::kNone;
using city::People;
using city::Person;
using city::Role;
using city::WalkRoute;
using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double kLookAhead = 0.6;  // metres before and behind that a walker's heading is taken over
constexpr double kNear = 2.5;       // metres ahead and behind in which one makes way
constexpr double kMostWait = 0.8;   // metres that who lets another go stays behind

/// A point of a route: where its middle is, and what is to the right.
struct OnRoute {
  dvec3 middle;
  dvec2 right;    // unit
  double steady;  // 1 on a straight way, 0 where it turns back on itself
  double free;
  bool deck;
};

/// Catmull–Rom would round corners into walls: the points are near enough to be joined by lines, and the right side is
/// taken from the neighbours of both ends, mixed.
OnRoute pointAt(const WalkRoute& route, double along) {
  const size_t n = route.points.size();
  const double length = route.length();
  double at = std::fmod(along, length);
  if (at < 0) at += length;
  const double steps = at / route.step;
  const size_t i = std::min(static_cast<size_t>(steps), n - 1), j = (i + 1) % n;
  const double f = std::clamp(steps - static_cast<double>(i), 0.0, 1.0);
  const auto rightAt = [&](size_t k) {
    const dvec2 d = dvec2(route.points[(k + 1) % n].position - route.points[(k + n - 1) % n].position);
    const double size = glm::length(d);
    return size > 1e-6 ? dvec2(d.y, -d.x) / size : dvec2(0);
  };
  OnRoute out;
  out.middle = glm::mix(route.points[i].position, route.points[j].position, f);
  out.right = glm::mix(rightAt(i), rightAt(j), f);
  out.steady = std::min(glm::length(out.right), 1.0);
  if (out.steady > 1e-6) out.right /= glm::length(out.right);
  out.free = glm::mix(static_cast<double>(route.points[i].free), static_cast<double>(route.points[j].free), f);
  out.deck = route.points[i].deck || route.points[j].deck;
  return out;
}

/// Metres a second at which a body's legs go as they were made or recorded.
double paceOf(const city::Character& body, Role role) {
  constexpr double kUsual = 1.2, kSlowest = 0.25, kFastest = 2.5;
  const city::Clip& clip = body.clips[static_cast<size_t>(role)];
  if (!(clip.duration > 0) || !(clip.stride > 0)) return kUsual;
  return std::clamp(clip.stride / clip.duration, kSlowest, kFastest);
}

bool walks(const People& people, const Person& person) {
  return person.route < people.routes.size() && people.routes[person.route].points.size() > 1 &&
         people.routes[person.route].step > 0;
}

/// How far to go aside (to where the other shall not be) when the other is `beside` metres on the side where he shall
/// be: nothing beyond kPassing, all that is missing nearer, and less and less once he is well on the wrong side, so
/// that it never jumps.
double asideFor(double beside) {
  if (beside >= kPassing || beside <= -kPassing) return 0;
  if (beside >= -0.5 * kPassing) return kPassing - beside;
  return 1.5 * kPassing * (beside + kPassing) / (0.5 * kPassing);
}

double bump(double x) {
  const double y = 1 - x * x;
  return y > 0 ? y * y : 0.0;
}

uint64_t squareOf(dvec2 p) {
  const auto part = [](double v) {
    return static_cast<uint64_t>(
        static_cast<uint32_t>(static_cast<int32_t>(std::floor(std::clamp(v / kNear, -1e9, 1e9)))));
  };
  return part(p.x) << 32U | part(p.y);
}

/// Calls visit(number) for everybody in the square of a place and the eight about it.
template <typename Visit>
void about(const Crowd& crowd, dvec2 at, const Visit& visit) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const uint64_t square = squareOf(at + kNear * dvec2(dx, dy));
      for (auto i = std::lower_bound(crowd.squares.begin(), crowd.squares.end(), std::pair(square, 0U));
           i != crowd.squares.end() && i->first == square; ++i)
        visit(i->second);
    }
}

}  // namespace

std::vector<Person> peopleOf(const People& people, size_t count) {
  std::vector<Person> out(people.placed.begin(),
                          people.placed.begin() + static_cast<std::ptrdiff_t>(std::min(count, people.placed.size())));
  if (people.characters.empty()) return {};
  double length = 0;
  std::vector<double> sums;
  for (const WalkRoute& r : people.routes) sums.push_back(length += r.length());
  size_t standing = 0;
  for (uint32_t i = 0; out.size() < count; ++i) {
    city::Random random(city::hash32(people.seed, i));
    Person p;
    p.character = random.below(static_cast<uint32_t>(people.characters.size()));
    const city::Character& body = people.characters[p.character];
    p.dress = random.below(static_cast<uint32_t>(std::max<size_t>(body.dresses.size(), 1)));
    p.scale = static_cast<float>(random.uniform(0.93, 1.07));
    const bool stands = random.below(3) == 0 || !(length > 0);
    if (stands && standing < people.places.size()) {
      const city::StandingPlace& place = people.places[standing++];
      p.role = random.below(2) == 0 ? Role::Talk : Role::Idle;
      p.position = place.position, p.heading = place.heading;
      p.start = random.uniform(0, 60), p.speed = static_cast<float>(random.uniform(0.8, 1.15));
    } else if (length > 0) {
      const double at = random.uniform(0, length);
      const auto route = std::upper_bound(sums.begin(), sums.end(), at);
      p.route = static_cast<uint32_t>(std::min<std::ptrdiff_t>(route - sums.begin(), std::ssize(sums) - 1));
      p.start = at;
      p.side = static_cast<float>(random.uniform(0.3, 0.95));
      p.role = body.carries ? Role::Carry : Role::Walk;
      p.speed = static_cast<float>(paceOf(body, p.role) * random.uniform(0.85, 1.2)) * p.scale;
    } else {
      break;
    }
    out.push_back(p);
  }
  return out;
}

Crowd crowdAt(const People& people, std::span<const Person> persons, double time) {
  if (!std::isfinite(time)) time = 0;
  Crowd crowd;
  crowd.walkers.reserve(persons.size());
  crowd.squares.reserve(persons.size());
  for (const Person& p : persons) {
    Walker w;
    w.at = dvec2(p.position), w.middle = p.position, w.walking = walks(people, p);
    if (w.walking) {
      w.along = p.start + static_cast<double>(p.speed) * time;
      const OnRoute point = pointAt(people.routes[p.route], w.along);
      w.at = dvec2(point.middle) + point.right * (static_cast<double>(p.side) * point.free);
      w.middle = point.middle, w.right = point.right, w.steady = point.steady;
      w.ahead = {-w.right.y, w.right.x};
    }
    crowd.squares.emplace_back(squareOf(w.at), static_cast<uint32_t>(crowd.walkers.size()));
    crowd.walkers.push_back(w);
  }
  std::sort(crowd.squares.begin(), crowd.squares.end());
  crowd.widest.reserve(people.routes.size());
  for (const WalkRoute& r : people.routes) {
    float widest = 0;
    for (const WalkRoute::Point& p : r.points) widest = std::max(widest, p.free);
    crowd.widest.push_back(static_cast<double>(widest));
  }
  return crowd;
}

double reachOf(const Crowd& crowd, std::span<const Person> persons, uint32_t i) {
  return crowd.walkers[i].walking ? kMostWait + crowd.widest[persons[i].route] : 0;
}

Place placeOf(const Crowd& crowd, const People& people, std::span<const Person> persons,
              const city::HeightField* terrain, uint32_t i) {
  const Person& person = persons[i];
  const Walker& me = crowd.walkers[i];
  if (!me.walking) return {person.position, person.heading, 0};
  // To the right, and on along the way.
  double right = 0, on = 0;
  about(crowd, me.at, [&](uint32_t j) {
    if (j == i) return;
    const Walker& other = crowd.walkers[j];
    const dvec2 to = other.at - me.at;
    const double ahead = glm::dot(to, me.ahead), toRight = glm::dot(to, me.right);
    const double near = bump(ahead / kNear) * me.steady * other.steady;
    if (near <= 0 || std::abs(toRight) > kNear) return;
    if (!other.walking) {
      right -= near * asideFor(toRight);  // pass on the left of who stands
      return;
    }
    const double same = glm::dot(me.ahead, other.ahead);
    if (same < 0) {
      right += -same * near * 0.5 * asideFor(-toRight);  // both keep right
    } else {
      // The faster passes on the left.
      const float mine = person.speed, his = persons[j].speed;
      const bool faster = mine != his ? mine > his : i < j;
      right += same * near * 0.5 * (faster ? -asideFor(toRight) : asideFor(-toRight));
    }
    // Whose way is crossed from the right lets the other go.
    const double crossing = 1 - std::abs(same);
    const double fromRight = std::clamp(toRight / kPassing, 0.0, 1.0) * me.steady * other.steady;
    on -= kMostWait * crossing * fromRight * bump(glm::length(to) / kNear);
  });
  const WalkRoute& route = people.routes[person.route];
  const double along = me.along + std::clamp(on, -kMostWait, 0.0);
  const auto sideAt = [&](double s) {
    const OnRoute p = pointAt(route, s);
    const double wanted = static_cast<double>(person.side) * p.free + std::clamp(right, -0.9, 0.9);
    return dvec2(p.middle) + p.right * std::clamp(wanted, -0.3 * p.free, p.free);
  };
  const OnRoute here = pointAt(route, along);
  const dvec2 at = sideAt(along);
  const dvec2 facing = sideAt(along + kLookAhead) - sideAt(along - kLookAhead);
  Place place;
  place.position = dvec3(at, here.middle.z);
  if (terrain && !here.deck) place.position.z = terrain->heightAt(at.x, at.y).value_or(here.middle.z);
  place.heading = static_cast<float>(glm::length(facing) > 1e-9 ? std::atan2(facing.y, facing.x)
                                                                : std::atan2(me.ahead.y, me.ahead.x));
  place.walked = along;
  return place;
}

std::vector<Place> placesAt(const People& people, std::span<const Person> persons, const city::HeightField* terrain,
                            double time) {
  const Crowd crowd = crowdAt(people, persons, time);
  std::vector<Place> out;
  out.reserve(persons.size());
  for (uint32_t i = 0; i < persons.size(); ++i) out.push_back(placeOf(crowd, people, persons, terrain, i));
  return out;
}

}  // namespace vicus::avatars
