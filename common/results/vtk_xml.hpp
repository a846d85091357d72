/// @file Snapshots for ParaView: VTK's XML format with the arrays appended as raw bytes (version 1.0, 64-bit headers).
/// Two-dimensional vectors get a third component of zero. Every file is whole at any moment (atomic_file.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "grainstep/wire.pb.h"

namespace grainstep::results::vtk {

/// Coordinates per point: 2 or 3.
[[nodiscard]] std::size_t dimension_of(const wire::Snapshot& snapshot);

/// Points with one vertex each and all point fields: PolyData (.vtp).
[[nodiscard]] std::string particles(const wire::Snapshot& snapshot);

/// Points of one cell: 3 of a triangle, 4 of a tetrahedron, 8 of a hexahedron.
[[nodiscard]] std::size_t points_per_cell(const wire::Snapshot& snapshot);

/// Cells with all point and cell fields: UnstructuredGrid (.vtu).
[[nodiscard]] std::string structure(const wire::Snapshot& snapshot);

/// A collection of files as one time series (.pvd).
class TimeSeries {
 public:
  explicit TimeSeries(std::filesystem::path path) : path_(std::move(path)) {}

  /// Adds `file`, a name relative to the collection, at `time` in s, and writes the collection anew.
  void add(double time, const std::string& file);

  /// Writes the collection anew when it is read back.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("entries", entries_);
    if constexpr (Archive::loads) write();
  }

 private:
  void write() const;  ///< nothing if there is nothing in it

  std::filesystem::path path_;
  std::string entries_;
};

}  // namespace grainstep::results::vtk
