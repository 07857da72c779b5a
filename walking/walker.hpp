/// A body on foot among walls, slopes, stairs and bridges.
///
/// The body is a cylinder of `kRadius` from `kLegs` to `kTall` above its feet, on a narrower one of `kLegRadius` from
/// `kStep` up: a capsule whose round foot passes over what can be stepped on. It moves in pieces of at most `kPiece`
/// metres, and each piece is a continuous sweep over the plan, so that no wall is too thin and no frame too long.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "city/city.hpp"
#include "walking/obstacles.hpp"

namespace vicus::walking {

constexpr double kRadius = 0.3;      ///< metres: half of a person's shoulders and a hand's breadth
constexpr double kLegRadius = 0.12;  ///< metres: half of a step's tread, so that stairs can be climbed
constexpr double kLegs = 1.0;        ///< metres above the feet where the body becomes wide: over tables and parapets
constexpr double kTall = 1.8;        ///< metres: head room
constexpr double kStep = 0.4;        ///< metres: the highest step that is climbed, or gone down
constexpr double kPiece = 0.2;       ///< metres: longest piece of a move, under a tread and a leg
constexpr double kDeepWater = 0.4;   ///< metres: nobody wades deeper

/// Where somebody stands.
struct Standing {
  glm::dvec2 at{0};  ///< metres from the city's origin
  double feet = 0;   ///< metres above the city's origin
};

/// A city as the visitor on foot meets it. Invariant: what `near` holds covers every question that was answered. The
/// city must outlive it.
class Ground {
 public:
  explicit Ground(const city::City& city) : city_(&city) {}

  /// The height of what one stands on at a point with the feet at about `feet`: the highest of the dry ground and the
  /// monuments' level surfaces up to a step above the feet. Nothing where that is more than a step higher or lower,
  /// where water on it is deeper than kDeepWater, or the point is not finite.
  std::optional<double> footing(glm::dvec2 point, double feet);

  /// Whether the body has room: no wall, monument or trunk reaches into it by more than a millimetre.
  bool fits(const Standing& standing);

  /// `footing` within a millimetre of the feet, and `fits`.
  bool stands(const Standing& standing);

  /// Moves by a displacement on the plan, sliding along what is in the way, climbing and going down steps. The result
  /// `stands` whenever the beginning does. A displacement that is not finite is none. In `blocked`, where given, the
  /// direction (unit, out of the wall) of what stopped the move last; zero where nothing did.
  Standing move(const Standing& from, glm::dvec2 displacement, glm::dvec2* blocked = nullptr);

  /// The nearest place about a point where one stands outside every building and every closed monument, level with
  /// `feet` where there is such ground (a deck), within `reach` metres. Nothing where there is none.
  std::optional<Standing> place(glm::dvec2 point, double feet, double reach = 60);

  /// Metres to the first wall along a unit direction of the plan at breast height; `reach` where none is nearer.
  double freeWay(const Standing& from, glm::dvec2 direction, double reach);

 private:
  /// A wall on the plan as the sweep sees it: `distance` metres are kept from it.
  struct Segment {
    glm::dvec2 a{0}, b{0};
    double distance = 0;
  };
  void need(glm::dvec2 point, double about);
  void segmentsAbout(glm::dvec2 min, glm::dvec2 max, double feet, std::vector<Segment>& out);
  std::optional<Standing> piece(const Standing& from, glm::dvec2 displacement, glm::dvec2& blocked, bool& noGround);
  bool outdoors(const Standing& standing);

  const city::City* city_;
  Obstacles near_;
  std::vector<Segment> scratch_;
};

}  // namespace vicus::walking
