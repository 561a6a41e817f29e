// TUM trajectories: "timestamp tx ty tz qx qy qz qw", a pose a line, '#' before comments:
// https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats.
#include <array>
#include <cmath>
#include <string>

#include "engine/io/file.hpp"
#include "engine/io/place.hpp"
#include "engine/io/readers.hpp"
#include "engine/io/text.hpp"

namespace landfall {
namespace io {
namespace {

constexpr std::array<const char*, 8> columns = {"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
constexpr double max_norm_error = 0.01;  // files round quaternions to a few digits
constexpr double max_tilt_rad = 0.17;    // 10 degrees: beyond it a heading in the plane means little

double read_column(Words& words, const Place& place, const char* column) {
  const std::string_view word = words.next();
  if (word.empty()) fail_format(place, column, "the end of the line", "8 numbers: t tx ty tz qx qy qz qw");
  const std::optional<double> value = parse_number(word);
  if (!value || !std::isfinite(*value)) fail_format(place, column, shown(word), "a finite number");
  return *value;
}

double read_heading(const std::array<double, 8>& row, const Place& place) {
  const double norm = std::hypot(std::hypot(row[4], row[5]), std::hypot(row[6], row[7]));
  if (std::abs(norm - 1.0) > max_norm_error)
    fail_format(place, "qx qy qz qw", "a quaternion of length " + shown(norm), "a unit quaternion");
  const double qx = row[4] / norm;
  const double qy = row[5] / norm;
  const double qz = row[6] / norm;
  const double qw = row[7] / norm;
  const double tilt_rad = 2.0 * std::asin(std::min(1.0, std::hypot(qx, qy)));
  if (tilt_rad > max_tilt_rad)
    fail_format(place, "qx qy qz qw", "a tilt of " + shown(tilt_rad) + " rad", "a rotation in the plane");
  return wrap_angle(std::atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz)));
}

StampedPose read_pose(std::string_view line, const Place& place) {
  Words words(line);
  std::array<double, 8> row{};
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = read_column(words, place, columns[i]);
  const std::string_view extra = words.next();
  if (!extra.empty()) fail_format(place, "column 9", shown(extra), "8 numbers: t tx ty tz qx qy qz qw");
  return {.stamp_s = row[0], .pose = {.x_m = row[1], .y_m = row[2], .theta_rad = read_heading(row, place)}};
}

}  // namespace

std::vector<StampedPose> read_trajectory(std::string_view tum, const std::string& file) {
  std::vector<StampedPose> poses;
  Lines lines(tum);
  for (std::string_view line; lines.next(line);) {
    const std::string_view first = Words(line).next();
    if (first.empty() || first[0] == '#') continue;
    poses.push_back(read_pose(line, {file, lines.number()}));
  }
  return poses;
}

}  // namespace io

std::vector<StampedPose> load_trajectory(const std::filesystem::path& tum) {
  return io::read_trajectory(io::read_text_file(tum), tum.string());
}

void save_trajectory(std::span<const StampedPose> poses, const std::filesystem::path& tum) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const auto& [stamp_s, pose] : poses) {
    const double half_rad = 0.5 * pose.theta_rad;
    io::append_number(text, stamp_s);
    for (const double value : {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, std::sin(half_rad), std::cos(half_rad)}) {
      text += ' ';
      io::append_number(text, value);
    }
    text += '\n';
  }
  io::write_file(tum, text);
}

}  // namespace landfall
