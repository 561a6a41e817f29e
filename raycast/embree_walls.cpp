#include "raycast/embree_walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

namespace landfall::raycast {
namespace {

// Low, so that the tree of boxes is split by what rays in the plane meet: 4 to 7 % over 0.5 m.
constexpr float half_height_m = 0.01f;

// Beyond it Embree takes no origin: builds with assertions, as Debian's, end the program.
constexpr float farthest_origin_m = 1e18f;

// Of what is not a number neither is true.
bool is_traceable(float x_m, float y_m) {
  return std::abs(x_m) <= farthest_origin_m && std::abs(y_m) <= farthest_origin_m;
}

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("Embree reports error " + std::to_string(error));
}

// Corners a, b at the foot, then b, a at the top. Walls that share an end point get equal corners, which
// is what makes their seam tight.
void write_quad(const Segment& wall, double center_x_m, double center_y_m, float* corners) {
  const auto ax = static_cast<float>(wall.ax_m - center_x_m);
  const auto ay = static_cast<float>(wall.ay_m - center_y_m);
  const auto bx = static_cast<float>(wall.bx_m - center_x_m);
  const auto by = static_cast<float>(wall.by_m - center_y_m);
  const std::array<float, 12> quad{ax, ay, -half_height_m, bx, by, -half_height_m,
                                   bx, by, half_height_m,  ax, ay, half_height_m};
  std::copy(quad.begin(), quad.end(), corners);
}

void attach_walls(RTCDevice device, RTCScene scene, std::span<const Segment> walls, double center_x_m,
                  double center_y_m) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * walls.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), walls.size()));
  if (corners != nullptr && indices != nullptr) {
    for (std::size_t i = 0; i < walls.size(); ++i)
      write_quad(walls[i], center_x_m, center_y_m, corners + 12 * i);
    for (std::size_t i = 0; i < 4 * walls.size(); ++i) indices[i] = static_cast<unsigned>(i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
  }
  rtcReleaseGeometry(geometry);
}

bool count_memory(void* memory_bytes, ssize_t change_bytes, bool /*post*/) {
  *static_cast<std::atomic<std::ptrdiff_t>*>(memory_bytes) += change_bytes;
  return true;
}

}  // namespace

EmbreeWalls::EmbreeWalls(std::span<const Segment> walls, double center_x_m, double center_y_m)
    : device_(rtcNewDevice(nullptr)), scene_(nullptr) {
  if (device_ == nullptr) check(nullptr);
  rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &memory_bytes_);
  scene_ = rtcNewScene(device_);
  // Robust: no ray slips through the seam of two walls (Woop et al. 2013, Watertight Ray/Triangle
  // Intersection).
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
  if (!walls.empty()) attach_walls(device_, scene_, walls, center_x_m, center_y_m);
  rtcCommitScene(scene_);
  try {
    check(device_);
  } catch (...) {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
    throw;
  }
}

std::size_t EmbreeWalls::memory_bytes() const {
  return static_cast<std::size_t>(memory_bytes_.load());
}

EmbreeWalls::~EmbreeWalls() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeWalls::trace(const RayPacket& packet, std::size_t count, Coherence coherence,
                        std::span<float> ranges_m) const {
  RTCRayHit8 lanes;
  alignas(32) std::array<int, packet_rays> valid;
  for (std::size_t i = 0; i < packet_rays; ++i) {
    valid[i] = i < count && is_traceable(packet.x_m[i], packet.y_m[i]) ? -1 : 0;
    lanes.ray.org_x[i] = packet.x_m[i];
    lanes.ray.org_y[i] = packet.y_m[i];
    lanes.ray.org_z[i] = 0.0f;
    lanes.ray.tnear[i] = 0.0f;
    lanes.ray.dir_x[i] = packet.dx[i];
    lanes.ray.dir_y[i] = packet.dy[i];
    lanes.ray.dir_z[i] = 0.0f;
    lanes.ray.time[i] = 0.0f;
    lanes.ray.tfar[i] = packet.range_max_m[i];
    lanes.ray.mask[i] = ~0u;
    lanes.ray.id[i] = 0;
    lanes.ray.flags[i] = 0;
    lanes.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    lanes.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  IntersectContext context(coherence);
  context.intersect(scene_, valid.data(), lanes);
  for (std::size_t i = 0; i < count; ++i)
    ranges_m[i] = lanes.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                                 : lanes.ray.tfar[i];
}

}  // namespace landfall::raycast
