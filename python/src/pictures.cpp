#include <roomlight/render.h>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

namespace roomlight::python {
namespace {

void bindSettings(py::module_& module) {
  py::class_<Settings>(module, "Settings")
      .def(py::init())
      .def_readwrite("technique", &Settings::technique)
      .def_readwrite("quality", &Settings::quality)
      .def_readwrite("width", &Settings::width)
      .def_readwrite("height", &Settings::height)
      .def_readwrite("samples", &Settings::samples)
      .def_readwrite("seed", &Settings::seed)
      .def_readwrite("threads", &Settings::threads)
      .def_readwrite("time_limit", &Settings::timeLimitS)
      .def_readwrite("noise_level", &Settings::noiseLevel)
      .def_readwrite("layers", &Settings::layers)
      .def_readwrite("layers_by_room", &Settings::layersByRoom)
      .def_readwrite("settings", &Settings::json);
  py::class_<View>(module, "View")
      .def(py::init())
      .def_readwrite("camera", &View::camera)
      .def_readwrite("kind", &View::kind)
      .def_readwrite("level", &View::level)
      .def_readwrite("room", &View::room)
      .def_readwrite("eye", &View::eye)
      .def_readwrite("target", &View::target)
      .def_readwrite("vertical_fov", &View::verticalFovDeg)
      .def_readwrite("cut", &View::cutM)
      .def_readwrite("metres_per_pixel", &View::metresPerPixel)
      .def_readwrite("backdrop", &View::backdrop);
  py::class_<DisplayOptions>(module, "DisplayOptions")
      .def(py::init())
      .def_readwrite("look", &DisplayOptions::look)
      .def_readwrite("exposure", &DisplayOptions::exposure)
      .def_readwrite("white_balance", &DisplayOptions::whiteBalance)
      .def_readwrite("tone", &DisplayOptions::tone)
      .def_readwrite("contrast", &DisplayOptions::contrast)
      .def_readwrite("saturation", &DisplayOptions::saturation)
      .def_readwrite("local_exposure", &DisplayOptions::localExposure)
      .def_readwrite("glare", &DisplayOptions::glare)
      .def_readwrite("vignette", &DisplayOptions::vignette);
}

void bindPicture(py::module_& module) {
  py::class_<Picture>(module, "Picture")
      .def("pixels", [](const Picture& picture) { return pixelsOf(picture.image()); })
      .def("complete", &Picture::complete)
      .def("camera", &Picture::camera)
      .def("stats", &Picture::stats)
      .def("display",
           [](const Picture& picture, const DisplayOptions& options) {
             return samplesOf(taken(unlocked([&] { return picture.display(options); })));
           })
      .def("write",
           [](const Picture& picture, const std::string& file, const DisplayOptions& options) {
             check(unlocked([&] { return picture.write(file, options); }));
           })
      .def("layers", [](const Picture& picture) { return taken(unlocked([&] { return picture.layers(); })); });
}

void writeSamples(const Bytes& samples, const std::string& file) {
  DisplayImage image;
  image.height = static_cast<int>(samples.shape(0)), image.width = static_cast<int>(samples.shape(1));
  image.channels = static_cast<int>(samples.shape(2));
  const std::span<const uint8_t> all = spanOf(samples);
  check(unlocked([&] {
    image.samples.assign(all.begin(), all.end());
    return write(image, file);
  }));
}

}  // namespace

void bindPictures(py::module_& module) {
  bindSettings(module);
  bindPicture(module);
  py::class_<Renderer>(module, "Renderer")
      .def_static("of",
                  [](const Home& home, const Settings& settings, const std::vector<View>& views) {
                    return taken(unlocked([&] { return Renderer::of(home, settings, views); }));
                  })
      .def("view_count", &Renderer::viewCount)
      .def("picture", [](Renderer& renderer, size_t view, const py::object& progress) {
        return valueOfLong(progress, [&](const Progress& p) { return renderer.picture(view, p); });
      });
  module.def("render", [](const Home& home, const View& view, const Settings& settings, const py::object& progress) {
    return valueOfLong(progress, [&](const Progress& p) { return render(home, view, settings, p); });
  });
  module.def("write", &writeSamples);
  module.def("techniques", &techniques);
  module.def("qualities", &qualities);
}

}  // namespace roomlight::python
