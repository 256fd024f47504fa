#include "arrays.h"

namespace roomlight::python {

py::array_t<float> pixelsOf(const Image& image) {
  auto* kept = new Image(image);
  const py::capsule owner(kept, [](void* p) { delete static_cast<Image*>(p); });
  py::array_t<float> array({image.height(), image.width(), 3}, image.rgb().data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array_t<uint8_t> samplesOf(DisplayImage image) {
  auto* kept = new DisplayImage(std::move(image));
  const py::capsule owner(kept, [](void* p) { delete static_cast<DisplayImage*>(p); });
  return py::array_t<uint8_t>({kept->height, kept->width, kept->channels}, kept->samples.data(), owner);
}

}  // namespace roomlight::python
