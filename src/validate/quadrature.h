// Illuminance by numerical integration in double precision: what the validation suite expects. Knows neither rays,
// voxels nor the program's own skies and glass, so that it can judge them.
#pragma once

#include <functional>
#include <vector>

namespace roomlight::quadrature {

struct Point {
  double x = 0, y = 0, z = 0;
};
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(Point a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(Point a, Point b);
double length(Point a);

// corner, corner + u, corner + u + v, corner + v; looks along cross(u, v).
struct Rectangle {
  Point corner, u, v;
};

// Where light is measured, and the unit normal of its side.
struct Element {
  Point position, normal;
};

// Luminance, cd/m², that arrives at the element from a point of a rectangle; `direction` is unit and points away from
// the element.
using Arriving = std::function<double(Point at, Point direction)>;

// Illuminance, lx, on the element from both sides of the rectangle: the integral of L cos cos / r² over its area, by
// Gauss-Legendre quadrature with 4 x 4 nodes in each of cells x cells parts. Nodes behind the element's horizon give
// nothing.
double illuminance(const Element& element, const Rectangle& rectangle, const Arriving& arriving, int cells = 16);

// The integral of f from a to b, 8 nodes in each of `cells` parts.
double integral(const std::function<double(double)>& f, double a, double b, int cells = 16);

// Of an element at `position` with unit `normal` towards a whole rectangle above its horizon: E = pi L times this
// (Lambert's formula for polygons: half the sum over edges of angle times the cosine of the edge's plane).
double configurationFactor(const Element& element, const Rectangle& rectangle);

// Part of a radiosity scene.
struct Radiosity {
  Rectangle rectangle;  // looks into the scene
  double albedo, exitance;  // lm/m² of its own
};
// Faces of a cube from (0, 0, 0) to (1, 1, 1), of which the first, the floor, shines.
std::vector<Radiosity> unitCube(double albedo, double exitanceOfFloor);

// Illuminance, lx, of elements in a scene of Lambertian rectangles without obstructions, by radiosity: each rectangle
// is cut into cells x cells patches of even radiosity, and patches light each other's middles, and the elements, by
// exact configuration factors. `direct`, where there is one, is light on the middles of patches from elsewhere: what
// they reflect of it reaches the elements, itself it does not.
std::vector<double> illuminance(const std::vector<Radiosity>& scene, const std::vector<Element>& elements, int cells,
                                const std::function<double(const Element&)>& direct = {});

}  // namespace roomlight::quadrature
