// Embree 3 or 4 behind one name. CMake says which: both headers may be installed.
#pragma once

#if LANDFALL_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace landfall::raycast {

enum class Coherence { coherent, incoherent };

// One context per batch: Embree 4 calls it arguments.
class IntersectContext {
 public:
#if LANDFALL_EMBREE_MAJOR >= 4
  explicit IntersectContext(Coherence coherence) {
    rtcInitIntersectArguments(&arguments_);
    arguments_.flags =
        coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
  void intersect(RTCScene scene, const int* valid, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &rays, &arguments_);
  }

 private:
  RTCIntersectArguments arguments_;
#else
  explicit IntersectContext(Coherence coherence) {
    rtcInitIntersectContext(&context_);
    context_.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                      : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  void intersect(RTCScene scene, const int* valid, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &context_, &rays);
  }

 private:
  RTCIntersectContext context_;
#endif
};

}  // namespace landfall::raycast
