/// @file Where things are in memory. The mesh is logically rectangular, so neighbours are found by arithmetic, and
/// eight quadrilaterals are read with contiguous loads.
///
/// Corner nodes: row j = 0..ny (0 is the loaded face), column i = 0..nx, at j * corner_stride + i.
/// Centre nodes: row j = 0..ny-1, at j * centre_stride + i.
/// State of a row of elements: batches of 8 quads; in a batch, component after component, 32 doubles each:
/// [component][triangle][quad]. Components 0..3 are the stress 11, 22, 12, 33; the others are the material's.
/// Triangles of a quad: 0 bottom (away from the loaded face), 1 right, 2 top, 3 left; corners counter-clockwise from
/// the lower left, triangle t = (corner t, corner t+1, centre).
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace grainstep::fe {

inline constexpr int kBatchQuads = 8;
inline constexpr int kQuadTriangles = 4;
inline constexpr int kBatchTriangles = kBatchQuads * kQuadTriangles;
inline constexpr std::size_t kAlignment = 64;

/// Every law's first components; its own begin at kStressState.
enum StressComponent : int { kXX, kYY, kXY, kZZ, kStressState };

template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  explicit AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{kAlignment})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{kAlignment}); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

using Array = std::vector<double, AlignedAllocator<double>>;

}  // namespace grainstep::fe
