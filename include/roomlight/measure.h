// Light meters in a home.
#pragma once

#include "roomlight/home.h"

namespace ROOMLIGHT_NAMESPACE {

struct MeterOptions {
  std::string technique = "hybrid", quality = "good";
  double tolerance = 0.02;  // relative standard error at which a meter is read
  uint64_t seed = 0;
  int threads = 0;  // 0: all cores
  // Of measure() alone:
  std::string meters = {};  // a meter file (docs/reference/meters.md); empty: every room
  bool daylightFactor = false;  // a second time, under a CIE overcast sky alone
};

struct Reading {
  float lux = 0, standardErrorLux = 0;
};

// What `roomlight measure` tells.
class ROOMLIGHT_API MeterReport {
 public:
  std::string table() const;  // for a terminal
  std::string json() const;
  std::string csv() const;  // one line a reading
  std::string html() const;  // a page for printing
  const std::vector<std::string>& warnings() const;

  struct State;
  explicit MeterReport(std::shared_ptr<const State> state) : state_(std::move(state)) {}

 private:
  std::shared_ptr<const State> state_;
};

// Rooms, or what a meter file asks for.
ROOMLIGHT_API Result<MeterReport> measure(const Home& home, const MeterOptions& options = {},
                                          const Progress& progress = {});

// A home lit for meters.
class ROOMLIGHT_API Meters {
 public:
  static Result<Meters> of(const Home& home, const MeterOptions& options = {}, const Progress& progress = {});
  // Illuminance of incident meters. `positions`, `normals`: 3 numbers a meter, m; normals need not be unit.
  Result<std::vector<Reading>> illuminance(std::span<const float> positions, std::span<const float> normals,
                                           const Progress& progress = {}) const;

  struct State;
  explicit Meters(std::shared_ptr<const State> state) : state_(std::move(state)) {}

 private:
  std::shared_ptr<const State> state_;
};

}  // namespace ROOMLIGHT_NAMESPACE
