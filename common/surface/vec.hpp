/// @file Vectors of two or three numbers, for geometry and contact laws.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace grainstep::surface {

template <std::size_t N>
struct Vec {
  std::array<double, N> c{};

  double& operator[](std::size_t i) { return c[i]; }
  const double& operator[](std::size_t i) const { return c[i]; }

  Vec& operator+=(const Vec& other) {
    for (std::size_t i = 0; i < N; ++i) c[i] += other.c[i];
    return *this;
  }
  Vec& operator-=(const Vec& other) {
    for (std::size_t i = 0; i < N; ++i) c[i] -= other.c[i];
    return *this;
  }
  Vec& operator*=(double factor) {
    for (double& x : c) x *= factor;
    return *this;
  }
  friend Vec operator+(Vec a, const Vec& b) { return a += b; }
  friend Vec operator-(Vec a, const Vec& b) { return a -= b; }
  friend Vec operator*(Vec a, double factor) { return a *= factor; }
  friend Vec operator*(double factor, Vec a) { return a *= factor; }
  friend Vec operator-(Vec a) { return a *= -1.0; }
  friend bool operator==(const Vec& a, const Vec& b) = default;
};

using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

template <std::size_t N>
double dot(const Vec<N>& a, const Vec<N>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

template <std::size_t N>
double norm(const Vec<N>& a) {
  return std::sqrt(dot(a, a));
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// Turned by +90 degrees: the outward normal's direction from a segment's tangent.
inline Vec2 turned_left(const Vec2& a) { return {{-a[1], a[0]}}; }

/// A plane vector in space.
inline Vec3 in_space(const Vec2& a) { return {{a[0], a[1], 0.0}}; }

}  // namespace grainstep::surface
