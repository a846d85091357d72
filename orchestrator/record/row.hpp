/// @file One row of the time series and ledgers: what results.h5 holds for one window (docs/user/results.md).
#pragma once

#include <vector>

#include "grainstep/wire.pb.h"
#include "ledger/ledger.hpp"
#include "results/results_file.hpp"
#include "scene/groups.hpp"

namespace grainstep::orchestrator {

/// Everything that is known about the end of one window.
struct RowData {
  double time = 0.0;           ///< s
  double mean_pressure = 0.0;  ///< Pa, over the row's interval (4.4)
  double transmitted = 0.0;    ///< Pa s (4.5)
  const wire::Report& impactor;
  const wire::Report& structure;
  const ledger::Balance& balance;
  unsigned dimension = 2;
};

[[nodiscard]] std::vector<results::Entry> series_row(const RowData& data, const scene::Groups& groups);
[[nodiscard]] std::vector<results::Entry> ledger_row(const RowData& data);

/// Wall clock times: the only rows that differ between two runs of one scene.
[[nodiscard]] std::vector<results::Entry> timing_row(const RowData& data);

}  // namespace grainstep::orchestrator
