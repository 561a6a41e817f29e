// A triangulation point T, its covariance P_T and number of triangulations n_t, refined reading by reading.
// Ivanjko, Petrovic & Miklic 2005, section 4; Wijk 2001, Triangulation Based Fusion of Sonar Data.
//
// The arcs' crossing is where the first two readings are linearised. The estimate there and after is least
// squares over the ranges and bearings of all readings that support it, each weighed by the sonar model, as
// an information filter. Changed: the crossing alone would ignore that targets far off the axes are as
// improbable as the model says, and its error is not P_T; this estimate's is, whatever the baseline.
#pragma once

#include "engine/mapping/tbf/sonar_reading.hpp"
#include "engine/mapping/tbf/symmetric2.hpp"

namespace landfall::internal {

class Triangulation {
 public:
  // n_t = 1: a reading and its first partner, whose arcs cross.
  Triangulation(const SonarReading& reading, const SonarReading& partner, const Point2& crossing_map);

  // Whether a further partner's range tells of the same target: within three sigma.
  [[nodiscard]] bool agrees_with(const SonarReading& partner) const;
  // n_t + 1.
  void refine(const SonarReading& partner);

  [[nodiscard]] const Point2& p_map() const { return p_map_; }
  [[nodiscard]] const Symmetric2& covariance_m2() const { return covariance_m2_; }
  [[nodiscard]] int triangulations() const { return triangulations_; }

 private:
  // The reading's range and bearing, linearised at the present estimate.
  void add(const SonarReading& reading, Point2& gradient);
  void step(const Point2& gradient);

  Point2 p_map_;
  Symmetric2 information_{};  // 1 / m^2
  Symmetric2 covariance_m2_{};
  int triangulations_ = 1;
};

}  // namespace landfall::internal
