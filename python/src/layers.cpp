#include <roomlight/layers.h>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

namespace roomlight::python {
namespace {

py::list infos(const Layers& layers) {
  py::list out;
  for (const LayerInfo& l : layers.list())
    out.append(py::make_tuple(l.name, l.kind, l.colour, l.kelvin, l.fluxLm, l.room));
  return out;
}

Image mixOf(const Layers& layers, const Dials& dials) {
  return taken(unlocked([&] { return layers.mix(dials); }));
}

}  // namespace

void bindLayers(py::module_& module) {
  py::class_<Dials>(module, "Dials")
      .def(py::init())
      .def_readwrite("lamps", &Dials::lamps)
      .def_readwrite("kelvin", &Dials::kelvin)
      .def_readwrite("sun", &Dials::sun)
      .def_readwrite("sky", &Dials::sky);
  py::class_<Layers>(module, "Layers")
      .def_static("open", [](const std::string& file) { return taken(unlocked([&] { return Layers::open(file); })); })
      .def("width", &Layers::width)
      .def("height", &Layers::height)
      .def("infos", &infos)
      .def("gains", [](const Layers& layers, const Dials& dials) { return rowsOf(taken(layers.gains(dials))); })
      .def("image",
           [](const Layers& layers, size_t i) { return pixelsOf(taken(unlocked([&] { return layers.image(i); }))); })
      .def("mix", [](const Layers& layers, const Dials& dials) { return pixelsOf(mixOf(layers, dials)); })
      .def("display",
           [](const Layers& layers, const Dials& dials, const DisplayOptions& options) {
             return samplesOf(taken(unlocked([&] { return layers.display(dials, options); })));
           })
      .def("write_linear", [](const Layers& layers, const Dials& dials, const std::string& file) {
        const Image mix = mixOf(layers, dials);
        check(unlocked([&] { return mix.write(file); }));
      });
}

}  // namespace roomlight::python
