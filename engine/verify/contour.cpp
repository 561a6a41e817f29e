#include "engine/verify/contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace landfall::internal {
namespace {

constexpr double piece_m = 0.2;     // long enough for its direction to survive the ranges' noise
constexpr double gap_m = 1.0;       // neighbours farther apart are not of one wall
constexpr double longest_m = 0.5;   // that two echoes at the ends of a gap stand for
constexpr double single_m = 0.1;    // that an echo without neighbours stands for
constexpr double place_m = 0.5;     // a square of this side holds as much: seen twice counts once
constexpr double at_least_m = 0.2;  // held in each direction

double distance_m(const Point2& a, const Point2& b) {
  const double x_m = a.x_m - b.x_m;
  const double y_m = a.y_m - b.y_m;
  return std::sqrt(x_m * x_m + y_m * y_m);  // hypot is slow
}

// What is left of a piece where squares hold no more than a wall that crosses them.
class Places {
 public:
  double take_m(const Point2& a, const Point2& b, double length_m) {
    double& taken_m = taken_at(square_of(a.x_m, b.x_m), square_of(a.y_m, b.y_m));
    const double left_m = std::min(length_m, place_m - taken_m);
    taken_m += left_m;
    return left_m;
  }

 private:
  // Far out all share the last one.
  static std::int32_t square_of(double a_m, double b_m) {
    constexpr double most = 1 << 30;
    return static_cast<std::int32_t>(std::floor(std::clamp(0.5 * (a_m + b_m) / place_m, -most, most)));
  }

  // The next piece mostly lies where the last one did.
  double& taken_at(std::int32_t x, std::int32_t y) {
    const auto key =
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
    if (last_ == nullptr || key != last_key_) last_ = &taken_m_[key];
    last_key_ = key;
    return *last_;
  }

  std::unordered_map<std::uint64_t, double> taken_m_;
  std::uint64_t last_key_ = 0;
  double* last_ = nullptr;
};

ContourPiece stretch(std::span<const EchoRay> echoes, std::size_t first, std::size_t last) {
  const Point2& a = echoes[first].end_robot;
  const Point2& b = echoes[last].end_robot;
  const double apart_m = distance_m(a, b);
  return {.first = first,
          .last = last,
          .normal_x = -(b.y_m - a.y_m) / apart_m,
          .normal_y = (b.x_m - a.x_m) / apart_m,
          .length_m = std::min(apart_m, longest_m)};
}

// An echo by itself says how far something is along its beam.
ContourPiece single(const EchoRay& echo, std::size_t index) {
  const double range_m = distance_m(echo.origin_robot, echo.end_robot);
  return {.first = index,
          .last = index,
          .normal_x = (echo.end_robot.x_m - echo.origin_robot.x_m) / range_m,
          .normal_y = (echo.end_robot.y_m - echo.origin_robot.y_m) / range_m,
          .length_m = single_m};
}

double explained_share(const ContourPiece& piece, const std::vector<bool>& explained) {
  std::size_t count = 0;
  for (std::size_t i = piece.first; i <= piece.last; ++i) count += explained[i] ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(piece.last - piece.first + 1);
}

}  // namespace

std::vector<ContourPiece> find_contour(std::span<const EchoRay> echoes) {
  std::vector<ContourPiece> pieces;
  Places places;
  const auto keep = [&](ContourPiece piece) {
    piece.length_m =
        places.take_m(echoes[piece.first].end_robot, echoes[piece.last].end_robot, piece.length_m);
    if (piece.length_m > 0.0) pieces.push_back(piece);
  };
  std::size_t first = 0;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const bool ends =
        i + 1 == echoes.size() || distance_m(echoes[i].end_robot, echoes[i + 1].end_robot) > gap_m;
    if (i > first && distance_m(echoes[first].end_robot, echoes[i].end_robot) >= piece_m) {
      keep(stretch(echoes, first, i));
      first = i;
    } else if (ends && i == first) {
      keep(single(echoes[i], i));
    }
    if (ends) first = i + 1;
  }
  return pieces;
}

double held_m2(std::span<const ContourPiece> pieces, const std::vector<bool>& explained) {
  double xx_m = at_least_m;
  double yy_m = at_least_m;
  double xy_m = 0.0;
  for (const ContourPiece& piece : pieces) {
    const double length_m = piece.length_m * explained_share(piece, explained);
    xx_m += length_m * piece.normal_x * piece.normal_x;
    yy_m += length_m * piece.normal_y * piece.normal_y;
    xy_m += length_m * piece.normal_x * piece.normal_y;
  }
  return std::max(at_least_m * at_least_m, xx_m * yy_m - xy_m * xy_m);
}

}  // namespace landfall::internal
