#include <algorithm>
#include <cctype>
#include <set>

#include "declare/suggest.hpp"
#include "orchestrator/record/summary.hpp"
#include "orchestrator/study/names.hpp"

namespace grainstep::study {
namespace {

using Json = nlohmann::ordered_json;

void collect_keys(const Json& object, const std::string& prefix, std::vector<std::string>& keys) {
  for (const auto& [key, value] : object.items()) {
    value.is_object() ? collect_keys(value, prefix + key + ".", keys) : keys.push_back(prefix + key);
  }
}

/// Every run has the same ones.
std::vector<std::string> summary_keys(const Plan& plan) {
  std::vector<std::string> keys;
  if (plan.points.empty()) return keys;
  const orchestrator::Preparation& some = plan.points.front().preparation;
  collect_keys(orchestrator::summary({.status = "",
                                      .reason = "",
                                      .scene = some.scene,
                                      .groups = some.groups,
                                      .plan = {},
                                      .findings = {},
                                      .impactor = {},
                                      .structure = {},
                                      .impactor_timing = {},
                                      .structure_timing = {}}),
               "", keys);
  return keys;
}

class Checker {
 public:
  Checker(const Plan& plan, Complaints& complaints) : plan_(plan), complaints_(complaints), known_(summary_keys(plan)) {
    places_.insert("reference");
    for (const PlannedPoint& point : plan.points) {
      places_.insert(point.series);
      places_.insert(point.id);
    }
  }

  void references() {
    for (int i = 0; i < plan_.study.reference_size(); ++i) {
      const std::string path = "reference." + std::to_string(i);
      if (point_of(plan_, plan_.study.reference(i)) == nullptr) {
        complain(path, "'" + plan_.study.reference(i) + "' is not a point of this study" +
                           place_hint(plan_.study.reference(i)));
      }
    }
  }

  void columns() {
    column_list(plan_.study.columns(), "columns", true);
    column_list(plan_.study.series_columns(), "series_columns", false);
  }

  void findings() {
    for (int i = 0; i < plan_.study.findings_size(); ++i) {
      const Finding& finding = plan_.study.findings(i);
      const std::string path = "findings." + std::to_string(i);
      place(path + ".on", finding.on());
      expression(path + ".value", finding.value());
      if (finding.has_expected() != finding.has_tolerance()) complain(path, "`expected` and `tolerance` go together");
    }
  }

  void plots() {
    for (int i = 0; i < plan_.study.plots_size(); ++i) {
      const Plot& plot = plan_.study.plots(i);
      const std::string path = "plots." + std::to_string(i);
      file_name(path + ".name", plot.name());
      expression(path + ".x", plot.x());
      expression(path + ".y", plot.y());
      for (int k = 0; k < plot.curves_size(); ++k) curve(path + ".curves." + std::to_string(k), plot.curves(k));
      for (int k = 0; k < plot.levels_size(); ++k) {
        if (plot.levels(k).has_x() == plot.levels(k).has_y()) {
          complain(path + ".levels." + std::to_string(k), "expected either x or y");
        }
      }
    }
  }

  void snapshots() {
    for (int i = 0; i < plan_.study.snapshots_size(); ++i) {
      const Snapshots& snapshots = plan_.study.snapshots(i);
      const std::string path = "snapshots." + std::to_string(i);
      file_name(path + ".name", snapshots.name());
      const PlannedPoint* point = point_of(plan_, snapshots.on());
      if (point == nullptr) {
        complain(path + ".on", "'" + snapshots.on() + "' is not a point of this study" + place_hint(snapshots.on()));
      } else if (point->preparation.scene.output().snapshots() == 0) {
        complain(path + ".on", "'" + snapshots.on() + "' records no snapshots; set output.snapshots for it");
      }
    }
  }

 private:
  /// Of a picture, beside the tables.
  void file_name(const std::string& path, const std::string& name) {
    const bool taken = !files_.insert(slug(name)).second;
    if (taken || slug(name) != name) complain(path, "'" + name + "' is taken, or cannot be the name of a file");
  }

  /// @param for_all later expressions may use them.
  void column_list(const google::protobuf::RepeatedPtrField<Column>& columns, const std::string& list, bool for_all) {
    std::set<std::string> names;
    for (int i = 0; i < columns.size(); ++i) {
      const std::string path = list + "." + std::to_string(i);
      const std::string& name = columns[i].name();
      expression(path + (columns[i].value().empty() ? ".name" : ".value"), formula_of(columns[i]));
      if (!names.insert(name).second) complain(path + ".name", "a second column of the name '" + name + "'");
      if (for_all) known_.push_back(name);
    }
  }

  void curve(const std::string& path, const Curve& curve) {
    place(path + ".on", curve.on());
    if (!curve.x().empty()) expression(path + ".x", curve.x());
    if (!curve.y().empty()) expression(path + ".y", curve.y());
  }

  void complain(const std::string& path, const std::string& text) {
    complaints_.add(declare::origin_of(plan_.tree, path), path, text);
  }

  [[nodiscard]] std::string place_hint(const std::string& where) const {
    return declare::hint(where, {places_.begin(), places_.end()});
  }

  void place(const std::string& path, const std::string& where) {
    if (!places_.contains(where)) {
      complain(path,
               "'" + where + "' is neither a series nor a point (series/point) of this study" + place_hint(where));
    }
  }

  void expression(const std::string& path, const std::string& text) {
    try {
      Expression(text).visit([&](const std::string& name, const std::string& where) {
        if (!where.empty()) place(path, where);
        if (!means_something(name)) {
          complain(path, "'" + name +
                             "' is no column above, no key of summary.json, no number of the scene and no dataset "
                             "(series.*, ledger.*, profiles.*, timings.*)" +
                             declare::hint(name, known_));
        }
      });
    } catch (const InputError& error) {
      complain(path, error.what());
    }
  }

  [[nodiscard]] bool means_something(const std::string& name) const {
    for (const char* group : {"series.", "ledger.", "profiles.", "timings."}) {
      if (name.starts_with(group)) return true;
    }
    const auto in_scene = [&](const PlannedPoint& point) {
      return number_at(point.preparation.scene, name).has_value();
    };
    return std::find(known_.begin(), known_.end(), name) != known_.end() ||
           std::any_of(plan_.points.begin(), plan_.points.end(), in_scene);
  }

  const Plan& plan_;
  Complaints& complaints_;
  std::vector<std::string> known_;
  std::set<std::string> places_;
  std::set<std::string> files_ = {"table", "series", "study"};
};

}  // namespace

void check_names(const Plan& plan, Complaints& complaints) {
  Checker checker(plan, complaints);
  checker.references();
  checker.columns();
  checker.findings();
  checker.plots();
  checker.snapshots();
}

}  // namespace grainstep::study
