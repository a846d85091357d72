/// @file Takes a backend through a run: what a participant's main calls.
///
///     participant                                orchestrator
///     Hello                              ->
///                                        <-      Setup
///     (prepare) Ready                    ->
///                                        <-      Start
///     Forces, Kinematics, Report, Snapshot, one window after the other
///                                        <-      Stop
///     Finished                           ->
///
/// A Stop in place of any of the orchestrator's messages ends the conversation with Finished and exit code 0.
#pragma once

#include <iosfwd>
#include <optional>

#include "participant/backend.hpp"
#include "participant/direct_path.hpp"
#include "transport/channel.hpp"

namespace grainstep::participant {

struct ServeOptions {
  double setup_deadline_s = 600.0;           ///< for Setup and for Start: the other side may have to prepare in between
  double data_deadline_s = 3600.0;           ///< for one message of the other side while the run goes on
  bool shared_memory = true;                 ///< data may take it where the orchestrator offers it (proto/README.md)
  std::optional<DirectOptions> direct = {};  ///< the same of a connection to the other side; Program::serving() has it
  std::ostream* errors = nullptr;            ///< where the one line about a bad end goes; nullptr: std::cerr
};

/// Runs the whole conversation and returns the program's exit code (base/error.hpp). Never throws: InputError,
/// NumericalError and other exceptions of the backend are sent as Error and written as one line; a lost or
/// misbehaving orchestrator ends with exit code 4. Destroy the channel before the process ends: that is what delivers
/// the last message. All of Timing but Timing.steps is filled in here; the backend fills in Timing.steps of its
/// reports.
[[nodiscard]] int serve_structure(transport::Channel& channel, StructureBackend& backend,
                                  const ServeOptions& options = {});

/// As above. In an MPI program only rank 0 calls this; the backend passes on to its other ranks what they need, and
/// ends them when link.surface() returns nullptr or throws.
[[nodiscard]] int serve_impactor(transport::Channel& channel, ImpactorBackend& backend,
                                 const ServeOptions& options = {});

}  // namespace grainstep::participant
