/// @file What a command line may ask for, a struct for each command.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/session/hub.hpp"

namespace grainstep::orchestrator {

struct SceneOptions {
  std::filesystem::path scene;
  std::vector<std::string> set;  ///< PATH=VALUE, in order
};

struct RunOptions {
  SceneOptions scene;
  std::filesystem::path out;  ///< empty: runs/<name of the scene>
  int ranks = 1;              ///< of the impactor
  int threads = 0;            ///< of both participants together; 0: as many as there are cores
  bool force = false;
  bool quiet = false;
  Deadlines deadlines;
  std::string listen;               ///< tcp://host:port for external participants; empty: a private ipc socket
  std::filesystem::path curve_dir;  ///< keys for tcp
  bool allow_plain_tcp = false;
  std::vector<std::string> external;  ///< "impactor", "structure"
  bool allow_program = false;         ///< that the scene names, and that is not ours
  bool allow_deck = false;            ///< LAMMPS scripts may be run
  double checkpoint_every_s = 600.0;  ///< 0: only before an end from outside
  int retry = 0;                      ///< how often a run that lost a participant goes on by itself
  bool resume = false;                ///< go on with what is in `out`
  std::optional<std::uint64_t> from;  ///< that window's checkpoint; the latest
  bool inexact = false;               ///< by another build, too
  std::string path = "auto";          ///< of data: auto, hub, shared, direct
};

struct CheckOptions {
  SceneOptions scene;
  int ranks = 1;  ///< of the impactor, that the cost is told for
  bool allow_program = false;
  bool allow_deck = false;
  Deadlines deadlines;
};

struct ShowOptions {
  std::filesystem::path directory;
  bool json = false;
};

struct StudyOptions {
  std::filesystem::path study;
  std::filesystem::path out;                 ///< empty: runs/studies/<name of the study>
  std::filesystem::path page;                ///< Markdown to write; empty: none
  std::vector<std::filesystem::path> reuse;  ///< directories with runs of other studies
  int jobs = 0;                              ///< runs at a time; 0: one per core
  int ranks = 1;                             ///< of every impactor
  bool include_long = false;
  bool full = false;    ///< with the study's overrides of that name
  bool repeat = false;  ///< compute again what is done, e.g. for timings
  bool retry = false;   ///< compute again what failed numerically
  bool allow_program = false;
  bool allow_deck = false;
  bool list = false;
  bool quiet = false;
};

struct ConformanceOptions {
  SceneOptions scene;                ///< no file: a scene of the type external, without settings
  std::string role;                  ///< "structure", "impactor"
  std::vector<std::string> only;     ///< names of clauses; empty: all
  std::vector<std::string> command;  ///< empty: the scene's program
  double patience_s = 20.0;
};

}  // namespace grainstep::orchestrator
