#include <algorithm>

#include "scenegraph/features.hpp"

namespace vicus::scenegraph {

Feature::Feature(std::string name) : node_(new osg::Group) {
  node_->setName(std::move(name));
}

void Feature::addSurface(osg::Node* node, const SurfaceStates& states, PassId pass) {
  surfaces_.push_back({node, states});
  addPass(pass);
}

void Feature::addPass(PassId pass) {
  if (std::find(passes_.begin(), passes_.end(), pass) == passes_.end()) passes_.push_back(pass);
}

void Feature::hide(const osg::Node* node, bool hidden) {
  for (Surface& s : surfaces_)
    if (s.node == node) s.hidden = hidden;
}

void Feature::show(Variant variant) {
  for (const Surface& s : surfaces_) {
    osg::StateSet* states = s.hidden ? nullptr : s.states.of(variant);
    s.node->setNodeMask(states ? ~0u : 0u);
    if (states && s.node->getStateSet() != states) s.node->setStateSet(states);
  }
}

}  // namespace vicus::scenegraph
