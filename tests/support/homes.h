// Homes of Sweet Home 3D for tests: a zip file made in memory, of Home.xml and whatever else.
#pragma once

#include <zip.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace roomlight::testing {

using ZipEntries = std::vector<std::pair<std::string, std::string>>;

inline std::string zipped(const ZipEntries& entries) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(source);
  zip_t* zip = zip_open_from_source(source, ZIP_TRUNCATE, &error);
  if (!zip) std::abort();
  for (const auto& [name, bytes] : entries) {
    zip_source_t* entry = zip_source_buffer(zip, bytes.data(), bytes.size(), 0);
    if (zip_file_add(zip, name.c_str(), entry, ZIP_FL_OVERWRITE | ZIP_FL_ENC_UTF_8) < 0) std::abort();
  }
  if (zip_close(zip) != 0) std::abort();
  zip_source_open(source);
  zip_source_seek(source, 0, SEEK_END);
  std::string out(static_cast<size_t>(zip_source_tell(source)), '\0');
  zip_source_seek(source, 0, SEEK_SET);
  zip_source_read(source, out.data(), out.size());
  zip_source_close(source);
  zip_source_free(source);
  return out;
}

// <home> with these elements in it.
inline std::string homeXml(const std::string& elements, const std::string& attributes = "wallHeight='250'") {
  return "<?xml version='1.0'?>\n<home version='7000' " + attributes + ">\n" + elements + "\n</home>\n";
}

// A wall from (x0, y0) to (x1, y1) in cm; `more`: further attributes.
inline std::string wallXml(const std::string& id, double x0, double y0, double x1, double y1, double thickness,
                           const std::string& more = "") {
  const auto n = [](double v) { return std::to_string(v); };
  return "<wall id='" + id + "' xStart='" + n(x0) + "' yStart='" + n(y0) + "' xEnd='" + n(x1) + "' yEnd='" + n(y1) +
         "' thickness='" + n(thickness) + "' " + more + "/>\n";
}

// Four joined walls around a rectangle on their axes, clockwise on the plan: their right sides look inwards.
inline std::string boxWalls(double width, double depth, double thickness, const std::string& more = "") {
  return wallXml("w0", 0, 0, width, 0, thickness, "wallAtStart='w3' wallAtEnd='w1' " + more) +
         wallXml("w1", width, 0, width, depth, thickness, "wallAtStart='w0' wallAtEnd='w2' " + more) +
         wallXml("w2", width, depth, 0, depth, thickness, "wallAtStart='w1' wallAtEnd='w3' " + more) +
         wallXml("w3", 0, depth, 0, 0, thickness, "wallAtStart='w2' wallAtEnd='w0' " + more);
}

inline std::string roomXml(const std::vector<std::pair<double, double>>& points, const std::string& more = "") {
  std::string out = "<room " + more + ">";
  for (const auto& [x, y] : points) out += "<point x='" + std::to_string(x) + "' y='" + std::to_string(y) + "'/>";
  return out + "</room>\n";
}

}  // namespace roomlight::testing
