// Error over time of one technique on one picture, and what is read off it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace roomlight {

struct StudyPoint {
  int samples = 0;                     // per pixel, as asked
  std::vector<double> runsS;           // seconds of each run
  double seconds = 0;                  // their median
  double processorSeconds = 0, memoryMiB = 0;  // of the first run
  double mse = 0, mseBeyondNoise = 0;  // compare.h; beyond noise: without that of the reference
  double flip = 0, meanErrorPercent = 0;
  std::string picture;                 // file in the study's folder
};

struct StudyCurve {
  std::string technique, kind;      // of StudyTechnique
  std::vector<StudyPoint> points;   // by samples
  std::string failed;               // why there are no (more) points; empty: nothing went wrong
};

// Twice the samples take away less than this part of the error: it has settled.
constexpr double kSettledChange = 0.05;
// Below this an error is that of rounding and of what references still hold.
constexpr double kLeastMse = 1e-6;

double medianOf(std::vector<double> values);  // 0 of none

// Error by which pictures are ranked: mse beyond the reference's noise, not below kLeastMse.
double errorOf(const StudyPoint& point);

// Whether the last two doublings changed next to nothing: one alone may be chance, or two samples that share what they
// see.
bool hasSettled(const StudyCurve& curve);

// The point from which on it does not get better by more than kSettledChange a doubling; the last one where the error
// still falls. The curve has points.
const StudyPoint& settledPoint(const StudyCurve& curve);

// Seconds until the error has come down to this: between two points along a straight line of logarithms, at once by the
// first where that is good enough. None where it never does.
std::optional<double> secondsTo(const StudyCurve& curve, double error);

// Seconds of `a` over seconds of `b` for the least error that both reach; none where one has no points.
std::optional<double> timeRatioAtEqualError(const StudyCurve& a, const StudyCurve& b);

}  // namespace roomlight
