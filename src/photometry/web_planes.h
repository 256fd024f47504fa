// From what a photometric file writes down to a whole web: planes that symmetry leaves out, other systems than C,
// gamma, and the flux that the file states.
#pragma once

#include <vector>

#include "photometry/photometric_text.h"
#include "photometry/photometric_web.h"

namespace roomlight::photometric {

// As it stands in a file, degrees and cd: one plane of candela for every angle.
struct Planes {
  std::vector<double> angleDeg;  // of the planes: C, or horizontal angles of types A and B
  std::vector<double> inPlaneDeg;
  std::vector<std::vector<double>> candela;
  size_t line = 0;  // where the angles of the planes stand, for complaints
};

enum class Symmetry {
  None,
  Rotation,    // one plane stands for all
  AboutC0,     // planes on one side of C0-C180
  AboutC90,    // planes on one side of C90-C270
  Quadrants,   // about both
};

// Angles must lie between low and high, or up to 0.01 degrees beyond, and ascend by 0.001 or more; fails with what they
// are.
void checkAngles(std::vector<double>& anglesDeg, size_t line, const std::string& what, double lowDeg, double highDeg);

// Planes to all of the circle. Planes in wrong order, a missing C0 and one that is written twice are oddities.
void fillWeb(Planes planes, Symmetry symmetry, PhotometricWeb& web, Oddities& odd);

// What the angles of type A or B mean; angles between -90 and 90 degrees (LM-63-2002, key definitions). For both,
// horizontal angles run clockwise seen from above or from C0. Type B: planes share the horizontal axis of C0, in which
// the vertical angle is 90 degrees; 0, 0 is the nadir. Type A: planes share the vertical axis; 0, 0 is the horizontal
// of C0, a vertical angle of -90 the nadir.
enum class System {
  A,
  B,
};

// Planes from -90 to 90, or from 0 where both sides are alike; resampled into C, gamma.
void resampleWeb(const Planes& planes, System system, PhotometricWeb& web);

// A web's own flux against what its file states. More than 2 % off is an oddity with both numbers. `whose`: the flux is
// that of "its lamps" or "the luminaire". A web without light is damage.
void checkFlux(const PhotometricWeb& web, const std::string& whose, Oddities& odd);

}  // namespace roomlight::photometric
