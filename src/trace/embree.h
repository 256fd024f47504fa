// Embree 3 and 4 by one face: what differs between the two, and no more. Which one, CMake has found.
#pragma once

#if ROOMLIGHT_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace roomlight {

// Rays must not slip through edges that triangles share. On arm64 Embree divides by estimates so coarse that some do,
// unless its slower, watertight test (Woop et al. 2013) is asked for.
#if defined(__aarch64__)
constexpr RTCSceneFlags kTight = RTC_SCENE_FLAG_ROBUST;
#else
constexpr RTCSceneFlags kTight = RTC_SCENE_FLAG_NONE;
#endif

// What goes along with rays: made once for many of them, by one thread. A filter function finds it by queryOf().
struct RayQuery {
  RayQuery() noexcept;
  RayQuery(const RayQuery&) = delete;
  RayQuery& operator=(const RayQuery&) = delete;

  void setCoherent();  // the rays of a packet stay close together
  // For all geometries of scenes that have kFilteredByQueries, after the filter that a geometry has of its own.
  void setFilter(RTCFilterFunctionN filter);

#if ROOMLIGHT_EMBREE == 3
  RTCIntersectContext context;  // first member: Embree hands back a pointer to it
#else
  RTCRayQueryContext context;  // first member: Embree hands back a pointer to it
  RTCIntersectArguments nearest;
  RTCOccludedArguments shadow;
#endif
};

// Query: derived from RayQuery, without virtual functions.
template <class Query>
const Query& queryOf(const RTCFilterFunctionNArguments* args) {
  return static_cast<const Query&>(*reinterpret_cast<const RayQuery*>(args->context));
}

#if ROOMLIGHT_EMBREE == 3

constexpr RTCSceneFlags kFilteredByQueries = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline RayQuery::RayQuery() noexcept { rtcInitIntersectContext(&context); }
inline void RayQuery::setCoherent() { context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT; }
inline void RayQuery::setFilter(RTCFilterFunctionN filter) { context.filter = filter; }

inline void intersect1(RTCScene scene, RayQuery& q, RTCRayHit* r) { rtcIntersect1(scene, &q.context, r); }
inline void intersect8(const int* valid, RTCScene scene, RayQuery& q, RTCRayHit8* r) {
  rtcIntersect8(valid, scene, &q.context, r);
}
inline void occluded1(RTCScene scene, RayQuery& q, RTCRay* r) { rtcOccluded1(scene, &q.context, r); }
inline void occluded8(const int* valid, RTCScene scene, RayQuery& q, RTCRay8* r) {
  rtcOccluded8(valid, scene, &q.context, r);
}

#else

constexpr RTCSceneFlags kFilteredByQueries = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline RayQuery::RayQuery() noexcept {
  rtcInitRayQueryContext(&context);
  rtcInitIntersectArguments(&nearest);
  rtcInitOccludedArguments(&shadow);
  nearest.context = shadow.context = &context;
}
inline void RayQuery::setCoherent() {
  nearest.flags = static_cast<RTCRayQueryFlags>(nearest.flags | RTC_RAY_QUERY_FLAG_COHERENT);
  shadow.flags = static_cast<RTCRayQueryFlags>(shadow.flags | RTC_RAY_QUERY_FLAG_COHERENT);
}
inline void RayQuery::setFilter(RTCFilterFunctionN filter) {
  nearest.filter = shadow.filter = filter;
  nearest.flags = static_cast<RTCRayQueryFlags>(nearest.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  shadow.flags = static_cast<RTCRayQueryFlags>(shadow.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
}

inline void intersect1(RTCScene scene, RayQuery& q, RTCRayHit* r) { rtcIntersect1(scene, r, &q.nearest); }
inline void intersect8(const int* valid, RTCScene scene, RayQuery& q, RTCRayHit8* r) {
  rtcIntersect8(valid, scene, r, &q.nearest);
}
inline void occluded1(RTCScene scene, RayQuery& q, RTCRay* r) { rtcOccluded1(scene, r, &q.shadow); }
inline void occluded8(const int* valid, RTCScene scene, RayQuery& q, RTCRay8* r) {
  rtcOccluded8(valid, scene, r, &q.shadow);
}

#endif

}  // namespace roomlight
