// The contour that a scan saw, and how well the part of it that a map explains holds a pose.
//
// A short piece of contour is found in many buildings, and so is a long one that is straight: what a chance
// match lacks is metres of confirmed wall, in two directions. Echoes count by the wall that they stand for,
// so that neither a dense sensor nor a wall nearby says more than it shows.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "landfall/pose2.hpp"

namespace landfall::internal {

// An echo in the robot's frame: where its beam began and ended.
struct EchoRay {
  Point2 origin_robot;
  Point2 end_robot;
};

// Neighbouring echoes [first, last] that stand for one stretch of wall.
struct ContourPiece {
  std::size_t first = 0;
  std::size_t last = 0;
  double normal_x = 0.0;  // of the stretch, in the robot's frame
  double normal_y = 0.0;
  double length_m = 0.0;
};

// Each place about once, however many echoes or scans of a composite show it. Echoes in the order of the
// beams.
std::vector<ContourPiece> find_contour(std::span<const EchoRay> echoes);

// Of the pieces, each weighed by the share of its echoes that are explained: the determinant, in square
// metres, of the sum of length x normal x normal^T, which is the product of the lengths that hold the pose
// along two perpendicular directions. Both begin at 0.2 m, so that it is never zero. explained[i]: of echo i.
double held_m2(std::span<const ContourPiece> pieces, const std::vector<bool>& explained);

}  // namespace landfall::internal
