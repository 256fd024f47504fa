#include "still/picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "trace/camera_rays.h"

namespace roomlight {
namespace {

std::string toText(Vec3 v) { return fmt::format("{:.4f} {:.4f} {:.4f}", v.x, v.y, v.z); }

// What viewers know panoramas by (Google's Photo Sphere XMP metadata).
std::string panoramaXmp(int width, int height) {
  return fmt::format(
      "<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?><x:xmpmeta "
      "xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\" xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
      "GPano:ProjectionType=\"equirectangular\" GPano:UsePanoramaViewer=\"True\" "
      "GPano:FullPanoWidthPixels=\"{0}\" GPano:FullPanoHeightPixels=\"{1}\" GPano:CroppedAreaImageWidthPixels=\"{0}\" "
      "GPano:CroppedAreaImageHeightPixels=\"{1}\" "
      "GPano:CroppedAreaLeftPixels=\"0\" GPano:CroppedAreaTopPixels=\"0\"/></rdf:RDF></x:xmpmeta><?xpacket end=\"w\"?>",
      width, height);
}

}  // namespace

Metadata metadataOf(const PictureOrigin& origin, const Camera& camera, const Rendered& rendered,
                    const Development& how) {
  auto times = nlohmann::ordered_json::object();
  for (const StageStats& s : rendered.stats.stages) times[s.name] = s.timeMs;
  RenderSettings settings = origin.settings;
  if (origin.reproducible) settings.threads = 0;  // a picture is the same with any number
  Metadata metadata = {
      {"roomlight.version", version()},
      {"roomlight.settings", settingsToJson(settings)},
      {"roomlight.seed", std::to_string(settings.seed)},
      {"roomlight.timesMs", times.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)},
      {"roomlight.scene", origin.scene},
      {"roomlight.lighting", origin.lighting},
      {"roomlight.camera", camera.name},
      {"roomlight.view", origin.view},
      {"roomlight.exposureEv100", fmt::format("{}", how.ev100)},
      {"roomlight.tone", std::string(toneCurveName(how.display.tone.curve))},
      {"roomlight.whiteK", fmt::format("{:.0f}", how.white.kelvin)},
      {"roomlight.whiteGains", toText(how.white.gains)},
      {kLightColourKey, toText(rendered.lightColour)},
      {"roomlight.complete", rendered.complete ? "true" : "false"}};
  if (camera.projection == Projection::Orthographic)
    metadata["roomlight.metresPerPixel"] =
        fmt::format("{}", CameraRays(camera, rendered.image.width, rendered.image.height).metresPerPixel());
  if (origin.reproducible) metadata.erase("roomlight.timesMs");
  if (camera.cutHeightM < kInfinity) metadata["roomlight.cutHeightM"] = fmt::format("{}", camera.cutHeightM);
  return metadata;
}

std::string lowerExtension(const std::filesystem::path& file) {
  std::string e = file.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

Status writePicture(const std::filesystem::path& file, const Camera& camera, const Rendered& rendered,
                    const Development& how, Metadata metadata) {
  const std::string extension = lowerExtension(file);
  if (extension == ".exr") return writeExr(file, rendered.image, metadata);
  const std::string xmp =
      camera.projection == Projection::Panorama ? panoramaXmp(rendered.image.width, rendered.image.height) : "";
  if (extension == ".jpg") return writeJpeg(file, developed(rendered, how, kPaperColour), SIZE_MAX, xmp);
  if (!xmp.empty()) metadata["XML:com.adobe.xmp"] = xmp;
  return writePng(file, developed(rendered, how, std::nullopt), metadata, opacityOf(rendered, camera));
}

}  // namespace roomlight
