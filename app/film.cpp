#include <utility>

#include "app/commands.hpp"
#include "viewer/film.hpp"

namespace vicus::app {

int film(const WalkOptions& options, const Surroundings& surroundings) {
  constexpr double kRate = 30;
  WalkOptions headless = options;
  headless.headless = true;
  headless.fps = options.fps.value_or(kRate);
  headless.every = 1;
  if (!viewer::isFilmName(options.film)) headless.out = std::exchange(headless.film, {});
  return walk(headless, surroundings);
}

}  // namespace vicus::app
