#include "raycast/ray_beams.hpp"

#include <cmath>

namespace landfall::raycast {
namespace {

// Packets wider than this are traced faster ray by ray (bench_raycast: 8 beams of 2 degrees).
constexpr float coherent_spread_rad = 0.2f;
constexpr float coherent_offset_m = 0.2f;

bool near_first_lane(const RayPacket& packet, std::size_t lane) {
  const float cos_between = packet.dx[0] * packet.dx[lane] + packet.dy[0] * packet.dy[lane];
  return cos_between >= std::cos(coherent_spread_rad) &&
         std::hypot(packet.x_m[lane] - packet.x_m[0], packet.y_m[lane] - packet.y_m[0]) <= coherent_offset_m;
}

}  // namespace

RayBeams::RayBeams(std::span<const Beam> beams) {
  for (std::size_t b = 0; b < beams.size(); ++b) {
    const Beam& beam = beams[b];
    if (beam.half_angle_rad > 0.0) continue;
    const std::size_t lane = beam_index_.size() % packet_rays;
    if (lane == 0) {
      packets_.push_back(RayPacket{});
      coherence_.push_back(Coherence::coherent);
    }
    RayPacket& packet = packets_.back();
    packet.x_m[lane] = static_cast<float>(beam.x_m);
    packet.y_m[lane] = static_cast<float>(beam.y_m);
    packet.dx[lane] = static_cast<float>(std::cos(beam.theta_rad));
    packet.dy[lane] = static_cast<float>(std::sin(beam.theta_rad));
    packet.range_max_m[lane] = static_cast<float>(beam.range_max_m);
    if (!near_first_lane(packet, lane)) coherence_.back() = Coherence::incoherent;
    beam_index_.push_back(b);
  }
}

RayPacket RayBeams::packet_from(std::size_t packet, float x_m, float y_m, float c, float s) const {
  const RayPacket& local = packets_[packet];
  RayPacket seen;
  for (std::size_t i = 0; i < packet_rays; ++i) {
    seen.x_m[i] = x_m + c * local.x_m[i] - s * local.y_m[i];
    seen.y_m[i] = y_m + s * local.x_m[i] + c * local.y_m[i];
    seen.dx[i] = c * local.dx[i] - s * local.dy[i];
    seen.dy[i] = s * local.dx[i] + c * local.dy[i];
    seen.range_max_m[i] = local.range_max_m[i];
  }
  return seen;
}

}  // namespace landfall::raycast
