/// @file Snapshots of both sides into a run's directory: a group each in results.h5, a file each for ParaView.
#pragma once

#include <cstdint>

#include "grainstep/wire.pb.h"
#include "results/results_file.hpp"
#include "results/run_directory.hpp"
#include "results/vtk_xml.hpp"

namespace grainstep::results {

class Snapshots {
 public:
  Snapshots(const RunDirectory& directory, ResultsFile& file);

  /// Snapshots of one side come in order of time (s). They are numbered from 0.
  void add(wire::Role side, double time, const wire::Snapshot& snapshot);

  template <class Archive>
  void serialize(Archive& archive) {
    for (Series* series : {&particles_, &impactor_, &structure_}) {
      archive("collection", series->collection);
      archive("count", series->count);
    }
  }

  [[nodiscard]] std::uint64_t count(wire::Role side) const { return series(side).count; }

 private:
  struct Series {
    const char* name;  ///< "particles", "impactor", "structure"
    vtk::TimeSeries collection;
    std::uint64_t count = 0;
  };
  [[nodiscard]] const Series& series(wire::Role side) const {
    if (side != wire::IMPACTOR) return structure_;
    return impactor_.count > 0 ? impactor_ : particles_;
  }
  void add_arrays(const std::string& group, double time, const wire::Snapshot& snapshot);

  RunDirectory directory_;
  ResultsFile& file_;
  Series particles_;
  Series impactor_;  ///< that is a mesh
  Series structure_;
};

}  // namespace grainstep::results
