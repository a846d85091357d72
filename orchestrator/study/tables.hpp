/// @file What a study leaves besides its runs: table.csv, series.csv, a CSV of curves per plot, study.json for whatever
/// draws or reads on.
#pragma once

#include <filesystem>
#include <vector>

#include "orchestrator/study/findings.hpp"

namespace grainstep::study {

struct Report {
  const Plan& plan;
  const std::vector<Outcome>& outcomes;
  const Numbers& numbers;
  const std::vector<Verdict>& verdicts;
};

/// One line per point: series, point, status, the study's columns (empty where there is no number), overrides, run
/// directory, reason of a failure.
[[nodiscard]] std::string table_csv(const Report& report, const std::filesystem::path& root);

/// One line per series, of the study's series_columns, and how many of its runs are done.
[[nodiscard]] std::string series_csv(const Report& report);
[[nodiscard]] std::size_t finished_runs(const Report& report, const std::string& series);

/// One line per vertex: curve, point, x, y. Vertices without both numbers are left out.
[[nodiscard]] std::string curves_csv(const Report& report, const Plot& plot);

/// Everything: points, findings, and how the plots are to be drawn.
[[nodiscard]] std::string study_json(const Report& report, const std::filesystem::path& root);

/// Writes all of them to `root`. @throws OutputError
void write_tables(const Report& report, const std::filesystem::path& root);

}  // namespace grainstep::study
