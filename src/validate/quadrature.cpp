#include "validate/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace roomlight::quadrature {
namespace {

// Nodes on [-1, 1] and weights, by Newton's method on Legendre's polynomials.
template <size_t N>
struct GaussLegendre {
  std::array<double, N> node, weight;
  GaussLegendre() {
    for (size_t i = 0; i < N; ++i) {
      double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (N + 0.5)), slope = 1;
      for (int k = 0; k < 50; ++k) {
        double p = 1, before = 0;
        for (size_t j = 0; j < N; ++j) {
          const double n = static_cast<double>(j), next = ((2 * n + 1) * x * p - n * before) / (n + 1);
          before = p, p = next;
        }
        slope = N * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      node[i] = x, weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
  }
};

Point normalized(Point a) { return a * (1 / length(a)); }

}  // namespace

Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double length(Point a) { return std::sqrt(dot(a, a)); }

double illuminance(const Element& element, const Rectangle& rectangle, const Arriving& arriving, int cells) {
  static const GaussLegendre<4> rule;
  const Point area = cross(rectangle.u, rectangle.v), normal = normalized(area);
  const double cell = 1.0 / cells, dA = length(area) * cell * cell / 4;
  double sum = 0;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      for (size_t b = 0; b < 4; ++b) {
        for (size_t a = 0; a < 4; ++a) {
          const double s = (i + (rule.node[a] + 1) / 2) * cell, t = (j + (rule.node[b] + 1) / 2) * cell;
          const Point q = rectangle.corner + rectangle.u * s + rectangle.v * t, d = q - element.position;
          const double r2 = dot(d, d);
          const Point w = d * (1 / std::sqrt(r2));
          const double cosine = dot(element.normal, w);
          if (cosine > 0)
            sum += rule.weight[a] * rule.weight[b] * dA * arriving(q, w) * cosine * std::abs(dot(normal, w)) / r2;
        }
      }
    }
  }
  return sum;
}

double integral(const std::function<double(double)>& f, double a, double b, int cells) {
  static const GaussLegendre<8> rule;
  const double h = (b - a) / cells;
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    for (size_t k = 0; k < 8; ++k) sum += rule.weight[k] * h / 2 * f(a + (i + (rule.node[k] + 1) / 2) * h);
  }
  return sum;
}

double configurationFactor(const Element& element, const Rectangle& rectangle) {
  // Corners above the horizon, the polygon cut where it sinks below.
  const Point corners[4] = {rectangle.corner, rectangle.corner + rectangle.u,
                            rectangle.corner + rectangle.u + rectangle.v, rectangle.corner + rectangle.v};
  std::vector<Point> seen;
  for (int i = 0; i < 4; ++i) {
    const Point a = corners[i] - element.position, b = corners[(i + 1) % 4] - element.position;
    const double ha = dot(a, element.normal), hb = dot(b, element.normal);
    if (ha >= 0) seen.push_back(a);
    if ((ha >= 0) != (hb >= 0)) seen.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  double sum = 0;
  for (size_t i = 0; i < seen.size(); ++i) {
    const Point a = seen[i], b = seen[(i + 1) % seen.size()], c = cross(a, b);
    const double sine = length(c);
    if (sine > 1e-15) sum += std::atan2(sine, dot(a, b)) * dot(c, element.normal) / sine;
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

std::vector<Radiosity> unitCube(double albedo, double exitanceOfFloor) {
  const Point o, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  return {{{o, z, x}, albedo, exitanceOfFloor},
          {{y, x, z}, albedo, 0},
          {{o, y, z}, albedo, 0},
          {{x, z, y}, albedo, 0},
          {{o, x, y}, albedo, 0},
          {{z, y, x}, albedo, 0}};
}

std::vector<double> illuminance(const std::vector<Radiosity>& scene, const std::vector<Element>& elements, int cells,
                                const std::function<double(const Element&)>& direct) {
  struct Patch {
    Rectangle rectangle;
    Element middle;
    double albedo, exitance;
  };
  std::vector<Patch> patches;
  for (const Radiosity& r : scene) {
    const Point u = r.rectangle.u * (1.0 / cells), v = r.rectangle.v * (1.0 / cells), normal = normalized(cross(u, v));
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        const Point corner = r.rectangle.corner + u * i + v * j;
        const Element middle{corner + u * 0.5 + v * 0.5, normal};
        patches.push_back({{corner, u, v}, middle, r.albedo, r.exitance + (direct ? r.albedo * direct(middle) : 0)});
      }
    }
  }
  const size_t n = patches.size(), each = static_cast<size_t>(cells) * static_cast<size_t>(cells);
  std::vector<double> factor(n * n);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j)
      factor[i * n + j] = i / each == j / each ? 0 : configurationFactor(patches[i].middle, patches[j].rectangle);
  }
  std::vector<double> radiosity(n);
  for (double change = 1; change > 1e-10;) {
    change = 0;
    for (size_t i = 0; i < n; ++i) {
      double irradiance = 0;
      for (size_t j = 0; j < n; ++j) irradiance += factor[i * n + j] * radiosity[j];
      const double next = patches[i].exitance + patches[i].albedo * irradiance;
      change = std::max(change, std::abs(next - radiosity[i]));
      radiosity[i] = next;
    }
  }
  std::vector<double> out;
  for (const Element& e : elements) {
    double sum = 0;
    // The rectangle that an element lies on does not light it.
    for (size_t j = 0; j < n; ++j) {
      if (std::abs(dot(patches[j].middle.position - e.position, patches[j].middle.normal)) > 1e-9)
        sum += configurationFactor(e, patches[j].rectangle) * radiosity[j];
    }
    out.push_back(sum);
  }
  return out;
}

}  // namespace roomlight::quadrature
