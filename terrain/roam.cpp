#include "terrain/roam.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

#include "terrain/roam_impl.hpp"

namespace vicus::terrain {

RoamFrame Roam::Impl::run(const Eye& next, uint32_t budget, double milliseconds) {
  operations = {};
  ++mesh->revision;
  if (started) touchedVertices.clear();  // the corners' places belong to the first frame
  touchedSlots.clear();
  RoamFrame result;
  result.stoppedBy = StoppedBy::Error;
  result.pixelError = next.wantedPixels;
  if (!patches.empty()) {
    turnTo(next, budget);
    result.stoppedBy = refineAndCoarsen(budget, milliseconds);
    if (result.stoppedBy != StoppedBy::Error)
      result.pixelError = std::max(next.wantedPixels, largestRatio() * next.pixelsPerRatio);
    work.clear();
    morph();
  }
  statedPixels = result.pixelError;
  finish(result);
  return result;
}

void Roam::Impl::turnTo(const Eye& next, uint32_t budget) {
  const Eye before = std::exchange(eye, next);
  const bool first = !started;
  if (first) start();
  if (!first && before == next && ordered == mayBind(budget)) return;
  if (before.planes != next.planes || before.position != next.position || first) carryFrustumDown();
  const bool rescaled =
      before.scaleSquared != next.scaleSquared || before.perspective != next.perspective || before.band != next.band;
  if (before.band != next.band)
    for (uint32_t d = 0; d < diamonds.size(); ++d)
      if (diamonds[d].split) reweigh.push_back(d);
  const bool wasOrdered = std::exchange(ordered, first || mayBind(budget));
  const bool reordered = ordered && !wasOrdered;
  if (next.perspective && before.perspective) path += glm::length(next.position - before.position);
  if (first || rescaled || reordered)
    lookAtAll();
  else
    lookAtDue();
  if (deferral.size() > 8 * diamonds.size() + 4096)
    deferral.purge([&](const Deferral::Entry& e) { return side(e.item).present && side(e.item).stamp == e.stamp; });
}

void Roam::Impl::start() {
  started = true;
  for (uint32_t id = 0; id < 2 * roots; ++id) draw(id);
}

bool Roam::Impl::fits(uint32_t id, uint32_t budget) {
  want(id);
  if (drawn.size() <= budget) return true;
  release(id);
  return false;
}

StoppedBy Roam::Impl::refineAndCoarsen(uint32_t budget, double milliseconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const bool timed = std::isfinite(milliseconds);
  uint32_t steps = 0;
  const auto late = [&] {
    return timed && (++steps & 15) == 0 &&
           std::chrono::duration<double, std::milli>(Clock::now() - begin).count() >= milliseconds;
  };

  // Coarsen: bucket 0 holds the sides that no longer need their split.
  while (!standing.empty() && standing.lowest() == 0) {
    if (late()) return StoppedBy::Time;
    release(standing.first(0));
  }
  // Refine from the worst down. At the budget the least needed splits make room for more needed ones; what has been
  // given up is not taken back in this frame, so it ends.
  uint32_t least = 1;
  while (true) {
    if (late()) return StoppedBy::Time;
    const bool over = drawn.size() > budget;
    const bool pending = !wanting.empty() && wanting.highest() >= least;
    if (!over && !pending) break;
    const uint32_t worst = pending ? wanting.highest() : 0;
    const uint32_t id = pending ? wanting.first(worst) : 0;
    if (!over && fits(id, budget)) continue;
    if (!ordered) {  // from here on the order counts
      ordered = true;
      lookAtAll();
      continue;
    }
    const bool canRelease = !standing.empty() && (over || standing.lowest() < worst);
    if (!canRelease) break;
    const uint32_t lowest = standing.lowest();
    least = std::max(least, lowest + 1);
    release(standing.first(lowest));
  }
  return drawn.size() > budget || !wanting.empty() ? StoppedBy::Budget : StoppedBy::Error;
}

void Roam::Impl::finish(RoamFrame& result) {
  result.mesh = mesh;
  result.revision = mesh->revision;
  result.triangleCount = static_cast<uint32_t>(drawn.size());
  result.trianglesInFrustum = visible;
  result.operations = operations;
  std::sort(touchedVertices.begin(), touchedVertices.end());
  touchedVertices.erase(std::unique(touchedVertices.begin(), touchedVertices.end()), touchedVertices.end());
  result.changedVertices = touchedVertices;
  result.changedTriangles.reserve(touchedSlots.size());
  std::sort(touchedSlots.begin(), touchedSlots.end());
  for (const uint32_t slot : touchedSlots)
    if (slot < drawn.size() && (result.changedTriangles.empty() || result.changedTriangles.back() != slot))
      result.changedTriangles.push_back(slot);
}

Roam::Roam(const city::HeightField& field, const ErrorTable& errors) : impl_(std::make_unique<Impl>(field, errors)) {}
Roam::~Roam() = default;
Roam::Roam(const Roam& other) : impl_(std::make_unique<Impl>(*other.impl_)) {
  impl_->mesh = std::make_shared<RoamMesh>(*impl_->mesh);
}
Roam& Roam::operator=(const Roam& other) {
  if (this != &other) *this = Roam(other);
  return *this;
}
Roam::Roam(Roam&&) noexcept = default;
Roam& Roam::operator=(Roam&&) noexcept = default;

RoamFrame Roam::update(const city::ViewState& view, const RoamSettings& settings) {
  assert(settings.pixelError > 0 && "the wanted error is above 0 pixels");
  assert(settings.morph > 0 && settings.morph <= 1 && "splits begin between no error and the wanted one");
  const bool finite = std::isfinite(view.eye.x) && std::isfinite(view.eye.y) && std::isfinite(view.eye.z);
  const Eye next = finite || !impl_->started ? eyeOf(view, settings, *impl_->field) : impl_->eye;
  return impl_->run(next, settings.budget, settings.milliseconds);
}

RoamFrame Roam::refine(double metres, uint32_t budget) {
  assert(metres > 0 && "the wanted error is above 0 metres");
  Eye eye;
  eye.scaleSquared = static_cast<float>(1 / (metres * metres));
  eye.scale = static_cast<float>(1 / metres);
  return impl_->run(eye, budget, std::numeric_limits<double>::infinity());
}

std::string Roam::broken() const {
  return impl_->broken();
}

size_t Roam::bytes() const {
  const Impl& roam = *impl_;
  return sizeof(Impl) + roam.diamonds.capacity() * sizeof(Diamond) + roam.vertexHeights.capacity() * sizeof(float) +
         roam.drawn.capacity() * sizeof(Drawn) + roam.mesh->triangles.capacity() * sizeof(roam.mesh->triangles[0]) +
         roam.mesh->vertices.capacity() * sizeof(RoamMesh::Vertex) + roam.deferral.size() * sizeof(Deferral::Entry);
}

}  // namespace vicus::terrain
