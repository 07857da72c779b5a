#include "assets/norvic/norvic.hpp"

namespace vicus::assets {

city::City generateNorwich2001(uint32_t seed, const Progress& progress) {
  return generateNorvic({800, seed}, progress);
}

}  // namespace vicus::assets
