#include "radiance/plane_area.h"

#include <bit>
#include <cmath>

namespace roomlight {

// The volume of the cube below the plane is a sum over its corners of cubes of clipped heights; the area is its derivative:
// |n| / (2 n1 n2 n3) * sum over corners v of (-1)^(v1+v2+v3) max(0, offset - n.v)^2, for n with positive components.
double planeAreaInUnitCube(Vec3 normal, double offset) {
  double n[3], length = 0;
  for (int k = 0; k < 3; ++k) {
    n[k] = std::abs(static_cast<double>(normal[k]));
    if (normal[k] < 0) offset += n[k];  // the cube mirrored along k
    n[k] = std::max(n[k], 1e-3);        // keeps the quotient finite; moves the plane by less than a thousandth
    length += n[k] * n[k];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double below = offset;
    for (int k = 0; k < 3; ++k) below -= (corner >> k) & 1 ? n[k] : 0;
    if (below > 0) sum += (std::popcount(static_cast<unsigned>(corner)) & 1 ? -1 : 1) * below * below;
  }
  return std::max(0.0, std::sqrt(length) * sum / (2 * n[0] * n[1] * n[2]));
}

}  // namespace roomlight
