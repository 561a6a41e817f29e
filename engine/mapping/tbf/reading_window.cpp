#include "engine/mapping/tbf/reading_window.hpp"

namespace landfall::internal {

ReadingWindow::ReadingWindow(int scans) : past_(static_cast<std::size_t>(scans - 1)) {}

void ReadingWindow::push(std::span<const SonarReading> readings) {
  if (past_.empty()) return;
  newest_ = (newest_ + 1) % past_.size();
  count_ = count_ < past_.size() ? count_ + 1 : count_;
  Column& column = past_[newest_];
  column.readings.assign(readings.begin(), readings.end());
  column.middle_x_m.clear();
  column.middle_y_m.clear();
  column.reach_m.clear();
  for (const SonarReading& reading : readings) {
    const Point2 middle_map = middle(reading.arc);
    column.middle_x_m.push_back(middle_map.x_m);
    column.middle_y_m.push_back(middle_map.y_m);
    column.reach_m.push_back(reach_m(reading.arc));
  }
}

std::optional<Triangulation> ReadingWindow::triangulate(const SonarReading& reading) const {
  const Point2 own = middle(reading.arc);
  const double own_reach_m = reach_m(reading.arc);
  std::optional<Triangulation> point;
  for (std::size_t age = 0; age < count_; ++age) {
    const Column& column = past_[(newest_ + past_.size() - age) % past_.size()];
    for (std::size_t i = 0; i < column.readings.size(); ++i) {
      const double dx = column.middle_x_m[i] - own.x_m;
      const double dy = column.middle_y_m[i] - own.y_m;
      const double both_m = column.reach_m[i] + own_reach_m;
      if (dx * dx + dy * dy > both_m * both_m) continue;
      const SonarReading& partner = column.readings[i];
      if (point && !point->agrees_with(partner)) continue;
      const std::optional<Point2> crossing_map = intersect(reading.arc, partner.arc);
      if (!crossing_map) continue;
      if (point)
        point->refine(partner);
      else
        point.emplace(reading, partner, *crossing_map);
    }
  }
  return point;
}

}  // namespace landfall::internal
