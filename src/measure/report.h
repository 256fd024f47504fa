// Measurements for people and for programs.
#pragma once

#include <string>

#include "measure/measurements.h"

namespace roomlight {

// What was measured, and how.
struct ReportHeader {
  std::string scene, lighting, meters;  // file names; empty: none
  std::string technique, quality, version;
  double tolerance = 0.02;
  std::string date;         // when, as people write it; empty: not said
  std::string pictureJpeg;  // bytes of a picture of the home; empty: none
  std::string pictureOf;    // what it shows
  std::string addedLight;   // where the home has none of its own; empty: nothing was added
};

std::string reportTable(const Measurements& m);                            // for a terminal
std::string reportJson(const ReportHeader& header, const Measurements& m);
// One line a reading: kind,name,room,x,y,z,nx,ny,nz,quantity,unit,value,place. Points that were left out have no value.
std::string reportCsv(const Measurements& m);
// One page on its own, without scripts, with a picture of the light on every grid (fine where it has a map).
std::string reportHtml(const ReportHeader& header, const Measurements& m, const Scene& scene);

}  // namespace roomlight
