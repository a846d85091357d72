/// @file Both participants of a run: which of them are ours to start, where they connect, and how they are started.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/temporary_directory.hpp"
#include "grainstep/scene.pb.h"
#include "orchestrator/options.hpp"
#include "orchestrator/supervision.hpp"
#include "results/run_directory.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::orchestrator {

/// By the scene or by the command line.
[[nodiscard]] bool is_external(wire::Role role, const scene::Scene& scene, const RunOptions& options);

/// InputError for connections that cannot be made, keys that cannot be used, and options that nobody would read: a
/// slip, and about encryption a dangerous one.
void check_connection(const scene::Scene& scene, const RunOptions& options);

/// A slug is computed by grainstep-dem; what else loads a structure, by grainstep-fe in the impactor's role.
[[nodiscard]] bool has_particles(const scene::Scene& scene);

/// Where the structure listens when the impactor does at `endpoint`: one port above, or at any free one (0, *) as well.
/// InputError for what is no port.
[[nodiscard]] std::string next_port(const std::string& endpoint);

class Participants {
 public:
  /// Opens both endpoints. InputError when one cannot be had.
  Participants(const scene::Scene& scene, const RunOptions& options);

  [[nodiscard]] transport::Channel& impactor() { return *impactor_.channel; }
  [[nodiscard]] transport::Channel& structure() { return *structure_.channel; }

  /// Starts those that are ours and prints, for the others, the command that starts them.
  void start(Supervision& supervision, const results::RunDirectory& directory);

  /// Takes the local sockets' names from the file system once both are connected, which needs them no more: whatever
  /// ends this process from then on, nothing of them stays.
  void close_doors() { sockets_.remove(); }

 private:
  struct Side {
    wire::Role role;
    bool external;
    bool mpi;
    std::vector<std::string> command;  ///< program and what it is told besides where to connect
    std::unique_ptr<transport::ZmqChannel> channel;
  };
  [[nodiscard]] std::string endpoint_of(const Side& side) const;
  void open(Side& side);
  void start(const Side& side, Supervision& supervision, const results::RunDirectory& directory) const;

  RunOptions options_;
  TemporaryDirectory sockets_;
  Side impactor_;
  Side structure_;
};

}  // namespace grainstep::orchestrator
