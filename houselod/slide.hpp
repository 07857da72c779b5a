/// How far what sticks out of a wall, or goes into it, is drawn from the wall's surface at a distance.
///
/// Based on: Willmott et al. 2001, §4.2.3. There an item is modelled at its full depth d; seen from D metres it is
/// pushed into its wall by the share t of d,
///
///   near = s · d,  far = 4 s · d,  t = 1 − (far − D) / (far − near), clamped to 0 … 1,
///
/// with the scalar s of the user. Ours is what is left, (1 − t) · d = clamp((4 d − D / s) / 3, 0, d): the same
/// line without the division by far − near, which is 0 for d = 0. Each vertex slides by its own distance from the wall,
/// so that an item is pressed flat and comes out at no wall's back, where the paper moves it as a whole.
#pragma once

namespace vicus::houselod {

/// Whole s for a picture: `scalar` is meant for a picture of 720 lines over 60°, one of finer pixels keeps detail from
/// farther away. The inverse is what all else computes with: 0 where nothing ever slides, kAllFlat where all is flat.
constexpr double kAllFlat = 1e30;
constexpr double kReferencePixels = 623.5382907247958;  ///< pixels per unit slope of 720 lines over 60°

/// 1 / s for a picture with so many pixels per unit slope. A scalar of 0, below or NaN gives kAllFlat, an infinite one
/// 0; `pixels` that are not finite or not positive count as the reference's.
double inverseScalar(double scalar, double pixels);

/// Metres that a point `depth` metres out of (negative: into) its wall's surface is drawn from it, seen from
/// `distance` metres: between 0 and `depth`, with its sign. 0 for depth 0; `depth` where the distance is not a number.
/// A depth that is not finite gives 0.
double slidTo(double depth, double distance, double inverseScalar);

/// The paper's t: 0 near, 1 where the point lies in the wall. 1 for depth 0 at any distance over 0.
double pushedIn(double depth, double distance, double inverseScalar);

/// Metres from which on a point of this depth lies in the wall: 4 s |depth|; infinite where nothing slides.
double flatFrom(double depth, double inverseScalar);

/// Farthest that anything appears from where it is modelled, in pixels of the picture that `inverseScalar` was made
/// for: where the slide ends a depth d = D / (4 s) has gone.
double largestErrorPixels(double inverseScalar, double pixels);

}  // namespace vicus::houselod
