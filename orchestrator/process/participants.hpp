/// @file Both participants of a run: which of them are ours to start, where they connect, and how they are started.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/temporary_directory.hpp"
#include "grainstep/scene.pb.h"
#include "orchestrator/options.hpp"
#include "orchestrator/process/supervision.hpp"
#include "orchestrator/process/threads.hpp"
#include "scene/needs.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::orchestrator {

/// By the scene or by the command line.
[[nodiscard]] bool is_external(wire::Role role, const scene::Scene& scene, const RunOptions& options);

/// InputError for connections that cannot be made, keys that cannot be used, and options that nobody would read: a
/// slip, and about encryption a dangerous one.
void check_connection(const scene::Scene& scene, const RunOptions& options);

/// InputError where the scene names a program that is not ours and nobody at this machine has said that it may run:
/// scenes travel between people.
void check_programs(const scene::Scene& scene, const RunOptions& options);
void check_deck(const scene::Scene& scene, const RunOptions& options);  ///< the same of a LAMMPS script

/// Where the structure listens when the impactor does at `endpoint`: one port above, or at any free one (0, *) as well.
/// InputError for what is no port.
[[nodiscard]] std::string next_port(const std::string& endpoint);

class Participants {
 public:
  /// Opens both endpoints. InputError when one cannot be had.
  Participants(const scene::Scene& scene, const RunOptions& options, const ThreadShares& threads = {});

  [[nodiscard]] transport::Channel& impactor() { return *impactor_.channel; }
  [[nodiscard]] transport::Channel& structure() { return *structure_.channel; }

  /// Whether the commands that start the others are printed.
  enum class Others { told, nothing };
  /// Starts those that are to be started here; their output goes to impactor.log and structure.log in `logs`.
  void start(Supervision& supervision, const std::filesystem::path& logs, Others others = Others::told);

  /// Takes the local sockets' names from the file system once all are connected, which needs them no more: whatever
  /// ends this process from then on, nothing of them stays.
  void close_doors() { sockets_.remove(); }

 private:
  struct Side {
    wire::Role role;
    bool external;
    scene::Program program;
    int threads;  ///< more than one only where it takes them
    bool deck;    ///< it will run a script, and was allowed to
    std::unique_ptr<transport::ZmqChannel> channel;
  };
  [[nodiscard]] std::string endpoint_of(const Side& side) const;
  [[nodiscard]] bool listens_for_data(const Side& side) const;
  void open(Side& side);
  void tell_how_to_start(const Side& side) const;
  void start(const Side& side, Supervision& supervision, const std::filesystem::path& logs) const;

  RunOptions options_;
  TemporaryDirectory sockets_;
  Side impactor_;
  Side structure_;
};

}  // namespace grainstep::orchestrator
