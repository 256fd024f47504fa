#include "trace/ray_scene.h"

#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/result.h"
#include "scene/surface.h"
#include "trace/embree.h"
#include "trace/even_transmittance.h"
#include "trace/surfaces.h"

namespace roomlight {
namespace {

// Above this many triangles in all, repeated meshes become Embree instances: slower to trace, but small.
constexpr size_t kFlattenLimit = 6'000'000;

struct GeometryTag {  // what a filter function needs to know of the geometry it is called for
  const Scene* scene;
  const Mesh* mesh;
  float through;  // where that is the same all over and from all sides; below 0: it is not
};

#if defined(__SANITIZE_THREAD__)
constexpr const char* kDeviceConfig = "threads=1";  // the sanitizer cannot see how oneTBB orders what builds share
#else
constexpr const char* kDeviceConfig = nullptr;
#endif

constexpr unsigned kStill = 0, kMoving = 1;  // parts of the top, once anything has moved

struct Query : RayQuery {
  const uint8_t* gone = nullptr;  // per instance; null: none is
  Vec3* left = nullptr;  // of shadow rays: one per ray of the packet, indexed by ray id
};

// Whether the surface of what has moved is met where it is no longer.
bool isGone(const RTCFilterFunctionNArguments* args, unsigned i) {
  const uint8_t* gone = queryOf<Query>(args).gone;
  return gone && RTCHitN_instID(args->hit, args->N, i, 0) == kStill && gone[RTCHitN_geomID(args->hit, args->N, i)];
}

void filterGone(const RTCFilterFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == -1 && isGone(args, i)) args->valid[i] = 0;
  }
}

bool isMasked(const Material& m) { return m.alphaMode == AlphaMode::Mask; }

// Masked-out texels are no surface.
void filterIntersect(const RTCFilterFunctionNArguments* args) {
  const auto* tag = static_cast<const GeometryTag*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    if (tag->through >= 0) {
      if (tag->through == 1) args->valid[i] = 0;
      continue;
    }
    const TrianglePoint p{RTCHitN_primID(args->hit, args->N, i), RTCHitN_u(args->hit, args->N, i),
                          RTCHitN_v(args->hit, args->N, i)};
    if (alphaAt(*tag->scene, *tag->mesh, p) == 0) args->valid[i] = 0;
  }
}

// Glass and blended surfaces reduce what is left; the ray goes on until nothing is.
void filterOccluded(const RTCFilterFunctionNArguments* args) {
  const auto* tag = static_cast<const GeometryTag*>(args->geometryUserPtr);
  const auto& query = queryOf<Query>(args);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] != -1) continue;
    if (isGone(args, i)) {  // this filter comes before that of the query
      args->valid[i] = 0;
      continue;
    }
    Vec3& left = query.left[RTCRayN_id(args->ray, n, i)];
    if (tag->through >= 0) {
      left *= tag->through;
      if (!isBlack(left)) args->valid[i] = 0;
      continue;
    }
    const TrianglePoint p{RTCHitN_primID(args->hit, n, i), RTCHitN_u(args->hit, n, i), RTCHitN_v(args->hit, n, i)};
    const Vec3 ng{RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i), RTCHitN_Ng_z(args->hit, n, i)};
    const Vec3 d{RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i), RTCRayN_dir_z(args->ray, n, i)};
    const float cosTheta = std::abs(dot(ng, d)) / std::sqrt(lengthSquared(ng) * lengthSquared(d));
    left *= straightTransmittance(*tag->scene, *tag->mesh, p, cosTheta);
    if (!isBlack(left)) args->valid[i] = 0;
  }
}

constexpr Affine kInPlace{};

}  // namespace

struct RayScene::State {
  const Scene* scene = nullptr;
  Bounds3 bounds;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  // Once anything has moved: what was there at first, and what has moved, which `top` holds then. Both in world space.
  RTCScene still = nullptr, moving = nullptr;
  std::vector<uint8_t> gone;  // per instance: what `still` holds of it is no longer there; empty before that
  std::vector<int> movingMesh;  // per instance: the mesh whose geometry `moving` has for it, or -1; empty before that
  bool shares = false;  // meshes are Embree instances, below which there can be no more
  RayLog* log = nullptr;
  std::vector<RTCScene> meshScenes;  // of instanced meshes, else null
  std::vector<GeometryTag> tags;  // one per mesh
  std::once_flag surfacesMade;
  std::unique_ptr<Surfaces> surfaces;

  ~State() {
    releaseScenes();
    if (device) rtcReleaseDevice(device);
  }
  void releaseScenes() {
    for (RTCScene* s : {&top, &still, &moving}) {
      if (*s) rtcReleaseScene(*s);
      *s = nullptr;
    }
    for (RTCScene s : meshScenes) {
      if (s) rtcReleaseScene(s);
    }
    meshScenes.clear();
  }

  void check() const;
  RTCGeometry makeGeometry(int meshIndex, const Affine& transform);
  void placeVertices(Vec3* vertices, const Mesh& mesh, const Affine& transform) const;
  void setFilters(RTCGeometry geometry, const Mesh& mesh) const;
  void build();
  void commitTop();
  RTCScene newScene() const;
  void part();
  void move(uint32_t instance);
  void begin(Query& query) const;
  void update(std::span<const uint32_t> changed);
  Hit hit(const RTCHit& met, float t) const;
  void note(RayLog::Kind kind, std::span<const Ray> rays) const {
    if (!log) return;
    log->batches.push_back({kind, log->rays.size(), rays.size()});
    log->rays.insert(log->rays.end(), rays.begin(), rays.end());
  }
};

// Embree keeps the first error of this thread until it is asked; what it could not make is null or empty.
void RayScene::State::check() const {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE && device) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw ResourceError("Embree cannot trace rays of this scene here: error " + std::to_string(static_cast<int>(error)));
}

RTCGeometry RayScene::State::makeGeometry(int meshIndex, const Affine& transform) {
  const Mesh& mesh = scene->meshes[static_cast<size_t>(meshIndex)];
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  check();
  auto* vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                              sizeof(Vec3), mesh.positions.size()));
  check();
  placeVertices(vertices, mesh, transform);
  // Copied rather than shared: Embree reads a few bytes past the last index.
  auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(uint32_t), mesh.triangleCount()));
  check();
  std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
  rtcSetGeometryUserData(geometry, &tags[static_cast<size_t>(meshIndex)]);
  setFilters(geometry, mesh);
  rtcCommitGeometry(geometry);
  return geometry;
}

// In world space, not placed by a transform: the same bits wherever it came from.
void RayScene::State::placeVertices(Vec3* vertices, const Mesh& mesh, const Affine& transform) const {
  parallelFor(mesh.positions.size(), 16384, [&](size_t i) { vertices[i] = transform.point(mesh.positions[i]); });
}

void RayScene::State::setFilters(RTCGeometry geometry, const Mesh& mesh) const {
  const Material& material = scene->materials[static_cast<size_t>(mesh.material)];
  rtcSetGeometryIntersectFilterFunction(geometry, isMasked(material) ? filterIntersect : nullptr);
  rtcSetGeometryOccludedFilterFunction(geometry, letsLightThrough(material) ? filterOccluded : nullptr);
}

// Embree leaves the normal in the space of the geometry.
Hit RayScene::State::hit(const RTCHit& met, float t) const {
  if (met.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const unsigned instID = met.instID[0];
  const Vec3 ng{met.Ng_x, met.Ng_y, met.Ng_z};
  if (!shares || instID == RTC_INVALID_GEOMETRY_ID) return {met.geomID, met.primID, met.u, met.v, t, ng};
  return {instID, met.primID, met.u, met.v, t, scene->instances[instID].worldFromObject.normal(ng)};
}

void RayScene::State::build() {
  if (!device) device = rtcNewDevice(kDeviceConfig);
  check();
  releaseScenes();
  top = newScene();
  rtcSetSceneBuildQuality(top, RTC_BUILD_QUALITY_MEDIUM);
  gone.clear(), movingMesh.clear();
  tags.clear();
  tags.reserve(scene->meshes.size());
  EvenTransmittance even(*scene);
  for (const Mesh& mesh : scene->meshes) tags.push_back({scene, &mesh, even.of(mesh)});
  meshScenes.assign(scene->meshes.size(), nullptr);

  std::vector<int> uses(scene->meshes.size(), 0);
  for (const Instance& instance : scene->instances) ++uses[static_cast<size_t>(instance.mesh)];
  const bool flatten = scene->triangleCount() <= kFlattenLimit;

  for (size_t i = 0; i < scene->instances.size(); ++i) {
    const Instance& instance = scene->instances[i];
    const auto meshIndex = static_cast<size_t>(instance.mesh);
    if (scene->meshes[meshIndex].triangleCount() == 0) continue;
    RTCGeometry geometry = nullptr;
    if (flatten || uses[meshIndex] == 1) {
      geometry = makeGeometry(instance.mesh, instance.worldFromObject);
    } else {
      shares = true;
      RTCScene& shared = meshScenes[meshIndex];
      if (!shared) {
        shared = rtcNewScene(device);
        rtcSetSceneFlags(shared, kTight);
        RTCGeometry triangles = makeGeometry(instance.mesh, Affine{});
        rtcAttachGeometryByID(shared, triangles, 0);
        rtcReleaseGeometry(triangles);
        rtcCommitScene(shared);
      }
      geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(geometry, shared);
      rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &instance.worldFromObject);
      rtcCommitGeometry(geometry);
    }
    rtcAttachGeometryByID(top, geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
  }
  commitTop();
}

RTCScene RayScene::State::newScene() const {
  RTCScene made = rtcNewScene(device);
  rtcSetSceneFlags(made, kFilteredByQueries | kTight);
  return made;
}

// A filter for all surfaces takes some hundredths of the rays' time, a build of the whole without what has moved a
// second.
void RayScene::State::begin(Query& query) const {
  if (gone.empty()) return;
  query.gone = gone.data();
  query.setFilter(filterGone);
}

void RayScene::State::commitTop() {
  rtcCommitScene(top);
  check();
  RTCBounds b;
  rtcGetSceneBounds(top, &b);
  bounds = {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

// Nothing has moved yet: all stays in one hierarchy, below a top that has room for another, in which each thing has its
// own, refitted as it moves on.
void RayScene::State::part() {
  still = top;
  moving = newScene(), top = newScene();
  rtcSetSceneFlags(moving, kFilteredByQueries | kTight | RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(moving, RTC_BUILD_QUALITY_LOW);
  gone.assign(scene->instances.size(), 0);
  movingMesh.assign(scene->instances.size(), -1);
  for (const RTCScene part : {still, moving}) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, part);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &kInPlace);
    rtcAttachGeometryByID(top, geometry, part == still ? kStill : kMoving);
    rtcReleaseGeometry(geometry);
  }
}

void RayScene::State::move(uint32_t index) {
  const Instance& instance = scene->instances[index];
  const Mesh& mesh = scene->meshes[static_cast<size_t>(instance.mesh)];
  gone[index] = 1;
  int& known = movingMesh[index];
  if (known == instance.mesh) {
    RTCGeometry geometry = rtcGetGeometry(moving, index);
    placeVertices(static_cast<Vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)), mesh,
                  instance.worldFromObject);
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    setFilters(geometry, mesh);
    rtcCommitGeometry(geometry);
    return;
  }
  if (known >= 0) rtcDetachGeometry(moving, index);
  known = -1;
  if (mesh.triangleCount() == 0) return;
  RTCGeometry geometry = makeGeometry(instance.mesh, instance.worldFromObject);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(moving, geometry, index);
  rtcReleaseGeometry(geometry);
  known = instance.mesh;
}

void RayScene::State::update(std::span<const uint32_t> changed) {
  if (changed.empty()) return;
  if (surfaces) surfaces->update(changed);
  if (shares) return build();
  if (!still) part();
  for (const uint32_t i : changed) move(i);
  rtcCommitScene(moving);
  for (const unsigned part : {kStill, kMoving}) rtcCommitGeometry(rtcGetGeometry(top, part));
  commitTop();
}

RayScene::RayScene(const Scene& scene) : state_(std::make_unique<State>()) {
  state_->scene = &scene;
  state_->build();
}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::update(std::span<const uint32_t> changedInstances) { state_->update(changedInstances); }
void RayScene::record(RayLog* log) { state_->log = log; }
const Scene& RayScene::scene() const { return *state_->scene; }
const Bounds3& RayScene::bounds() const { return state_->bounds; }
const Surfaces& RayScene::surfaces() const {
  std::call_once(state_->surfacesMade, [&] { state_->surfaces = std::make_unique<Surfaces>(*state_->scene); });
  return *state_->surfaces;
}

namespace {

RTCRay rtcRay(const Ray& ray) {
  const Vec3 o = ray.origin, d = ray.direction;
  return {o.x, o.y, o.z, ray.tMin, d.x, d.y, d.z, 0, ray.tMax, 0xffffffffu, 0, 0};
}

}  // namespace

Hit RayScene::intersect(const Ray& ray) const {
  Query query;
  state_->begin(query);
  RTCRayHit r;
  r.ray = rtcRay(ray);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  intersect1(state_->top, query, &r);
  return state_->hit(r.hit, r.ray.tfar);
}

Vec3 RayScene::transmittance(const Ray& ray) const {
  Vec3 left(1);
  Query query;
  state_->begin(query);
  query.left = &left;
  RTCRay r = rtcRay(ray);
  occluded1(state_->top, query, &r);
  return r.tfar < 0 ? Vec3(0) : left;
}

namespace {

// Fills lane i of an eight-wide ray.
template <class Ray8>
void setLane(Ray8& r, unsigned i, const Ray& ray) {
  r.org_x[i] = ray.origin.x, r.org_y[i] = ray.origin.y, r.org_z[i] = ray.origin.z;
  r.dir_x[i] = ray.direction.x, r.dir_y[i] = ray.direction.y, r.dir_z[i] = ray.direction.z;
  r.tnear[i] = ray.tMin, r.tfar[i] = ray.tMax;
  r.time[i] = 0, r.mask[i] = 0xffffffffu, r.id[i] = i, r.flags[i] = 0;
}

// Fills the lanes from the n-th on, which are not valid: on processors without AVX Embree goes by tnear > tfar instead,
// and looks at what else the lanes hold.
template <class Ray8>
void closeLanes(Ray8& r, unsigned n, const Ray& like) {
  for (unsigned i = n; i < 8; ++i) {
    setLane(r, i, like);
    r.tnear[i] = 1, r.tfar[i] = 0;
  }
}

RTCHit laneOf(const RTCHit8& hits, unsigned i) {
  RTCHit hit{};
  hit.Ng_x = hits.Ng_x[i], hit.Ng_y = hits.Ng_y[i], hit.Ng_z = hits.Ng_z[i];
  hit.u = hits.u[i], hit.v = hits.v[i];
  hit.primID = hits.primID[i], hit.geomID = hits.geomID[i], hit.instID[0] = hits.instID[0][i];
  return hit;
}

}  // namespace

void RayScene::intersect(std::span<const Ray> rays, std::span<Hit> hits) const { intersectPackets(rays, hits, false); }
void RayScene::intersectClose(std::span<const Ray> rays, std::span<Hit> hits) const {
  intersectPackets(rays, hits, true);
}

void RayScene::intersectPackets(std::span<const Ray> rays, std::span<Hit> hits, bool close) const {
  state_->note(close ? RayLog::Kind::NearestClose : RayLog::Kind::Nearest, rays);
  Query query;
  state_->begin(query);
  if (close) query.setCoherent();
  for (size_t first = 0; first < rays.size(); first += 8) {
    alignas(32) RTCRayHit8 r;
    alignas(32) int valid[8] = {};
    const auto n = static_cast<unsigned>(std::min<size_t>(8, rays.size() - first));
    for (unsigned i = 0; i < n; ++i) {
      setLane(r.ray, i, rays[first + i]);
      r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      valid[i] = -1;
    }
    closeLanes(r.ray, n, rays[first]);
    intersect8(valid, state_->top, query, &r);
    for (unsigned i = 0; i < n; ++i) hits[first + i] = state_->hit(laneOf(r.hit, i), r.ray.tfar[i]);
  }
}

void RayScene::transmittance(std::span<const Ray> rays, std::span<Vec3> left) const {
  state_->note(RayLog::Kind::Shadow, rays);
  Query query;
  state_->begin(query);
  for (size_t first = 0; first < rays.size(); first += 8) {
    Vec3 lanes[8];
    query.left = lanes;
    alignas(32) RTCRay8 r;
    alignas(32) int valid[8] = {};
    const auto n = static_cast<unsigned>(std::min<size_t>(8, rays.size() - first));
    for (unsigned i = 0; i < n; ++i) {
      setLane(r, i, rays[first + i]);
      lanes[i] = Vec3(1);
      valid[i] = -1;
    }
    closeLanes(r, n, rays[first]);
    occluded8(valid, state_->top, query, &r);
    for (unsigned i = 0; i < n; ++i) left[first + i] = r.tfar[i] < 0 ? Vec3(0) : lanes[i];
  }
}

}  // namespace roomlight
