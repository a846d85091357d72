/// @file Reports and snapshots of one participant, looked at as a stranger would: their names become datasets and
/// files, their numbers become sizes and indices.
#pragma once

#include <map>
#include <string>

#include "orchestrator/session/peer.hpp"

namespace grainstep::orchestrator {

/// A name that may become one of results.h5: lower case letters, digits and `_`, a letter first, at most 64 of them.
[[nodiscard]] bool is_name(const std::string& name);

/// Remembers what the first report and the first snapshot held: a dataset has a value in every row.
class ReportCheck {
 public:
  explicit ReportCheck(unsigned dimension) : dimension_(dimension) {}

  /// PeerError: which entry of the report of `window`, what was found, what is expected.
  void report(const Peer& peer, const wire::Report& report);
  void snapshot(const Peer& peer, const wire::Snapshot& snapshot) const;

 private:
  void momentum(const Peer& peer, const wire::Report& report) const;
  void observables(const Peer& peer, const wire::Report& report);

  unsigned dimension_;
  bool first_ = true;
  std::map<std::string, std::string> units_;  // of the observables, by name
};

}  // namespace grainstep::orchestrator
