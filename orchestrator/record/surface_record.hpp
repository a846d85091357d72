/// @file surface.h5 of a run (`output.record`): impulses, positions and velocities of the surface's nodes, one row for
/// each window. replay/format.hpp says what is in it; grainstep-replay plays it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "grainstep/record.pb.h"
#include "grainstep/scene.pb.h"
#include "grainstep/wire.pb.h"
#include "results/results_file.hpp"
#include "transport/channel.hpp"

namespace grainstep::orchestrator {

/// What a record says of its scene; what both sides said is still to be added. `window`: s.
[[nodiscard]] record::About about_record(const scene::Scene& scene, std::uint64_t hash, double window);

class SurfaceRecord {
 public:
  /// Of a run that begins. OutputError where the file cannot be made.
  SurfaceRecord(const std::filesystem::path& file, const record::About& about);

  /// Of a run that goes on after `window`: what came later is taken away.
  SurfaceRecord(const std::filesystem::path& file, const record::About& about, std::uint64_t window);

  /// The impactor's of window 0.
  void first_report(const wire::Report& impactor);
  void kinematics(const wire::Kinematics& kinematics);
  void forces(const wire::Forces& forces);

  /// What is pending, where it is much or old.
  void flush_if_due();
  void flush();

 private:
  void begin();

  record::About about_;
  results::ResultsFile file_;
  std::vector<double> position_, velocity_;  ///< at the end of the window whose Forces come next
  transport::Clock::time_point flushed_ = transport::Clock::now();
};

}  // namespace grainstep::orchestrator
