// What each part of the library adds to the module `_roomlight`. The package's own files say what users see of it.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <roomlight/basics.h>

#include <array>

namespace roomlight::python {

void bindHome(pybind11::module_& module);
void bindPictures(pybind11::module_& module);
void bindLayers(pybind11::module_& module);
void bindMeters(pybind11::module_& module);
void bindProgram(pybind11::module_& module);

}  // namespace roomlight::python

// Places are any three numbers, and tuples on the way back.
template <>
struct pybind11::detail::type_caster<roomlight::Vec3> {
  PYBIND11_TYPE_CASTER(roomlight::Vec3, const_name("tuple[float, float, float]"));

  bool load(handle from, bool convert) {
    make_caster<std::array<float, 3>> numbers;
    if (!numbers.load(from, convert)) return false;
    const auto& n = static_cast<std::array<float, 3>&>(numbers);
    value = {n[0], n[1], n[2]};
    return true;
  }
  static handle cast(const roomlight::Vec3& v, return_value_policy, handle) {
    return pybind11::make_tuple(v.x, v.y, v.z).release();
  }
};
