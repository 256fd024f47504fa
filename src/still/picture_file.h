// Pictures as files: .exr in linear light, .png and .jpg for displays, with what they are as metadata.
#pragma once

#include <filesystem>
#include <string>

#include "base/image_layers.h"
#include "engine/settings.h"
#include "still/developed.h"

namespace roomlight {

// How a picture came to be, for its metadata.
struct PictureOrigin {
  RenderSettings settings;
  std::string scene, lighting, view;  // names of files, and of the view ("camera", "plan")
  bool reproducible = false;  // without what differs from run to run
};
Metadata metadataOf(const PictureOrigin& origin, const Camera& camera, const Rendered& rendered,
                    const Development& how);

// ".exr", ".png": in small letters.
std::string lowerExtension(const std::filesystem::path& file);

// By the extension: .exr, .jpg, else PNG.
Status writePicture(const std::filesystem::path& file, const Camera& camera, const Rendered& rendered,
                    const Development& how, Metadata metadata);

}  // namespace roomlight
