#include <roomlight/measure.h>
#include <roomlight/optimise.h>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

namespace roomlight::python {
namespace {

py::list designsOf(const std::vector<Design>& designs) {
  py::list out;
  for (const Design& d : designs)
    out.append(
        py::make_tuple(d.name, d.objectives, d.fittings, d.installedW, d.lightingFiles, d.largestDifferencePercent));
  return out;
}

void bindOptimise(py::module_& module) {
  py::class_<OptimiseOptions>(module, "OptimiseOptions")
      .def(py::init())
      .def_readwrite("method", &OptimiseOptions::method)
      .def_readwrite("quality", &OptimiseOptions::quality)
      .def_readwrite("evaluations", &OptimiseOptions::evaluations)
      .def_readwrite("certified", &OptimiseOptions::certified)
      .def_readwrite("seed", &OptimiseOptions::seed)
      .def_readwrite("metres_per_unit", &OptimiseOptions::metresPerUnit)
      .def_readwrite("seconds", &OptimiseOptions::seconds)
      .def_readwrite("threads", &OptimiseOptions::threads);
  module.def("optimise", [](const std::string& home, const std::string& study, const std::string& folder,
                            const OptimiseOptions& options, const py::object& progress) {
    return designsOf(
        valueOfLong(progress, [&](const Progress& p) { return optimise(home, study, folder, options, p); }));
  });
}

}  // namespace

void bindMeters(py::module_& module) {
  py::class_<MeterOptions>(module, "MeterOptions")
      .def(py::init())
      .def_readwrite("technique", &MeterOptions::technique)
      .def_readwrite("quality", &MeterOptions::quality)
      .def_readwrite("tolerance", &MeterOptions::tolerance)
      .def_readwrite("seed", &MeterOptions::seed)
      .def_readwrite("threads", &MeterOptions::threads)
      .def_readwrite("meters", &MeterOptions::meters)
      .def_readwrite("daylight_factor", &MeterOptions::daylightFactor);
  py::class_<MeterReport>(module, "MeterReport")
      .def("table", &MeterReport::table)
      .def("json", &MeterReport::json)
      .def("csv", &MeterReport::csv)
      .def("html", &MeterReport::html)
      .def("warnings", &MeterReport::warnings);
  py::class_<Meters>(module, "Meters")
      .def_static("of",
                  [](const Home& home, const MeterOptions& options, const py::object& progress) {
                    return valueOfLong(progress, [&](const Progress& p) { return Meters::of(home, options, p); });
                  })
      .def("illuminance",
           [](const Meters& meters, const Floats& positions, const Floats& normals, const py::object& progress) {
             return rowsOf(valueOfLong(progress, [&](const Progress& p) {
               return meters.illuminance(spanOf(positions), spanOf(normals), p);
             }));
           });
  module.def("measure", [](const Home& home, const MeterOptions& options, const py::object& progress) {
    return valueOfLong(progress, [&](const Progress& p) { return measure(home, options, p); });
  });
  bindOptimise(module);
}

}  // namespace roomlight::python
