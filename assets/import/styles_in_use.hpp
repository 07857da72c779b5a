/// The styles that a city's houses are built by, each with its paints entered into the city's materials.
#pragma once

#include <memory>
#include <vector>

#include "assets/import/finishes.hpp"
#include "facade/house.hpp"

namespace vicus::assets {

struct Assembly;

/// Invariant: numbers stay valid, and so do the styles, whatever is added later.
class StylesInUse {
 public:
  /// Number of a style; it is loaded and entered where it is new. One that cannot be loaded becomes `plain`, with what
  /// is wrong in the assembly's diagnostics.
  size_t use(Assembly& assembly, const Style& style);
  const std::vector<facade::StyleInUse>& list() const { return inUse_; }

 private:
  std::vector<Style> wanted_;
  std::vector<std::unique_ptr<const facade::Style>> styles_;
  std::vector<facade::StyleInUse> inUse_;
};

}  // namespace vicus::assets
