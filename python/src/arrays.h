// NumPy arrays that are the library's memory, and spans of the library that are NumPy's.
#pragma once

#include <pybind11/numpy.h>

#include <roomlight/picture.h>

#include <cstdint>
#include <span>
#include <vector>

namespace roomlight::python {

namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style>;
using Indices = py::array_t<uint32_t, py::array::c_style>;
using Bytes = py::array_t<uint8_t, py::array::c_style>;

// Height x width x 3, read-only: the image's own memory, which the array keeps.
py::array_t<float> pixelsOf(const Image& image);

// Height x width x channels: the samples, moved into the array.
py::array_t<uint8_t> samplesOf(DisplayImage image);

// Rows of as many floats as T has: the values, moved into the array.
template <class T>
py::array_t<float> rowsOf(std::vector<T> values) {
  static_assert(sizeof(T) % sizeof(float) == 0);
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<float>({kept->size(), sizeof(T) / sizeof(float)}, reinterpret_cast<const float*>(kept->data()),
                            owner);
}

// Of the array's memory: valid while the array is, and nobody resizes it.
template <class T, int kFlags>
std::span<const T> spanOf(const py::array_t<T, kFlags>& array) {
  return {array.data(), static_cast<size_t>(array.size())};
}

}  // namespace roomlight::python
