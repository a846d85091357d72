/// @file What names in a study's expressions mean. Of a run: its columns, keys of summary.json
/// (`wall_split.impactor_wait`), numbers of its resolved scene in SI (`impactor.slug.speed`), datasets of results.h5
/// with dots for slashes (`series.t_bar`). Of a series: the list of all that over its finished runs.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/study/complaints.hpp"
#include "orchestrator/study/expression.hpp"
#include "orchestrator/study/outcome.hpp"

namespace grainstep::study {

/// The number at a path of a message, in SI; nullopt where there is none.
[[nodiscard]] std::optional<double> number_at(const google::protobuf::Message& message, const std::string& path);

/// What a column's value is made of.
[[nodiscard]] inline const std::string& formula_of(const Column& column) {
  return column.value().empty() ? column.name() : column.value();
}

/// Complains about expressions that cannot be read, names that mean nothing, and places (`on`, `reference`, in()) that
/// are not in the study.
void check_names(const Plan& plan, Complaints& complaints);

/// The numbers of a study's runs. Order of calls: make it, compute_columns, then ask. Refers to what it is made of.
class Numbers {
 public:
  Numbers(const Plan& plan, const std::vector<Outcome>& outcomes);
  ~Numbers();
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;

  void compute_columns();
  /// In the order of the study's columns; NaN where there is none.
  [[nodiscard]] double column(std::size_t point, const std::string& name) const;

  /// A column of the series' table; NaN where nothing of it is done.
  [[nodiscard]] double of_series(const std::string& series, const Column& column) const;

  [[nodiscard]] const Names& of_point(std::size_t point) const;
  /// A point's id, a series' name, or `reference`; nullptr if nothing of it is done.
  [[nodiscard]] const Names* of(const std::string& where) const;

 private:
  class OfPoint;
  class OfSeries;
  friend class OfPoint;

  const Plan& plan_;
  const std::vector<Outcome>& outcomes_;
  std::vector<std::map<std::string, double>> columns_;
  std::vector<std::unique_ptr<OfPoint>> points_;
  std::map<std::string, std::unique_ptr<OfSeries>> series_;
  std::optional<std::size_t> reference_;
};

}  // namespace grainstep::study
