#include "orchestrator/study/tables.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/number_text.hpp"
#include "declare/declaration.hpp"
#include "orchestrator/record/summary.hpp"
#include "results/atomic_file.hpp"

namespace grainstep::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// RFC 4180.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string cell(double value) { return std::isfinite(value) ? number_text(value) : ""; }

std::string relative_to(const fs::path& root, const fs::path& path) {
  const fs::path relative = path.lexically_relative(root);
  return relative.empty() || *relative.begin() == ".." ? path.string() : relative.string();
}

std::string joined(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : "; ") + text;
  return out;
}

/// A curve to be drawn: of a series' points, or of one run's history.
struct Wanted {
  std::string on;
  std::string label;
  std::string x;
  std::string y;
  Curve::Style style = Curve::STYLE_AUTO;
};

std::vector<Wanted> wanted_curves(const Report& report, const Plot& plot) {
  std::vector<Wanted> out;
  for (const Curve& curve : plot.curves()) {
    out.push_back({.on = curve.on(),
                   .label = curve.label().empty() ? curve.on() : curve.label(),
                   .x = curve.x().empty() ? plot.x() : curve.x(),
                   .y = curve.y().empty() ? plot.y() : curve.y(),
                   .style = curve.style()});
  }
  if (!out.empty()) return out;
  std::string last;
  for (const PlannedPoint& point : report.plan.points) {
    const std::string& on = plot.kind() == Plot::KIND_HISTORIES ? point.id : point.series;
    if (on != last) out.push_back({.on = on, .label = on, .x = plot.x(), .y = plot.y()});
    last = on;
  }
  return out;
}

void append_vertices(std::string& out, const std::string& label, const std::string& point, const Values& x,
                     const Values& y) {
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (std::isfinite(x[i]) && std::isfinite(y[i])) {
      out += cell(label) + "," + cell(point) + "," + cell(x[i]) + "," + cell(y[i]) + "\n";
    }
  }
}

std::string word(const google::protobuf::EnumDescriptor& type, int number) { return declare::word_for(type, number); }

Json plot_json(const Report& report, const Plot& plot) {
  Json out = {{"name", plot.name()},
              {"title", plot.title().empty() ? report.plan.study.title() : plot.title()},
              {"kind", word(*Plot::Kind_descriptor(), plot.kind())},
              {"x_label", plot.x_label().empty() ? plot.x() : plot.x_label()},
              {"y_label", plot.y_label().empty() ? plot.y() : plot.y_label()},
              {"log_x", plot.log_x()},
              {"log_y", plot.log_y()},
              {"front", plot.front()},
              {"names", plot.names()},
              {"legend", word(*Plot::Legend_descriptor(), plot.legend())},
              {"curves", Json::array()},
              {"marks", Json::array()},
              {"levels", Json::array()}};
  for (const Wanted& curve : wanted_curves(report, plot)) {
    out["curves"].push_back({{"label", curve.label}, {"style", word(*Curve::Style_descriptor(), curve.style)}});
  }
  for (const Mark& mark : plot.marks())
    out["marks"].push_back({{"x", mark.x()}, {"y", mark.y()}, {"label", mark.label()}});
  for (const Level& level : plot.levels()) {
    out["levels"].push_back(
        {{"axis", level.has_x() ? "x" : "y"}, {"at", level.has_x() ? level.x() : level.y()}, {"label", level.label()}});
  }
  return out;
}

Json snapshots_json(const Report& report, const Snapshots& snapshots, const fs::path& root) {
  Json out = {{"name", snapshots.name()},
              {"title", snapshots.title().empty() ? report.plan.study.title() : snapshots.title()},
              {"directory", nullptr},
              {"times", snapshots.times()}};
  const auto point = static_cast<std::size_t>(point_of(report.plan, snapshots.on()) - report.plan.points.data());
  const Outcome& outcome = report.outcomes[point];
  if (outcome.state == Outcome::State::done) out["directory"] = relative_to(root, outcome.directory);
  return out;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json point_json(const Report& report, std::size_t i, const fs::path& root) {
  const PlannedPoint& point = report.plan.points[i];
  const Outcome& outcome = report.outcomes[i];
  Json out = {{"series", point.series},
              {"point", point.name},
              {"status", state_name(outcome.state)},
              {"reason", outcome.reason},
              {"directory", relative_to(root, outcome.directory)},
              {"scene_key", point.key},
              {"set", point.set},
              {"values", Json::object()}};
  for (const Column& column : report.plan.study.columns()) {
    out["values"][column.name()] = number(report.numbers.column(i, column.name()));
  }
  return out;
}

Json finding_json(const Finding& finding, const Verdict& verdict) {
  return {{"statement", finding.statement()}, {"on", finding.on()},        {"value", number(verdict.value)},
          {"unit", finding.unit()},           {"wanted", verdict.wanted},  {"verdict", state_name(verdict.state)},
          {"source", finding.source()},       {"reason", finding.reason()}};
}

}  // namespace

std::size_t finished_runs(const Report& report, const std::string& series) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < report.plan.points.size(); ++i) {
    count += report.plan.points[i].series == series && report.outcomes[i].state == Outcome::State::done ? 1 : 0;
  }
  return count;
}

std::string table_csv(const Report& report, const fs::path& root) {
  const auto& columns = report.plan.study.columns();
  std::string out = "series,point,status";
  for (const Column& column : columns) out += "," + cell(column.name());
  out += ",set,directory,reason\n";
  for (std::size_t i = 0; i < report.plan.points.size(); ++i) {
    const PlannedPoint& point = report.plan.points[i];
    const Outcome& outcome = report.outcomes[i];
    out += cell(point.series) + "," + cell(point.name) + "," + state_name(outcome.state);
    for (const Column& column : columns) out += "," + cell(report.numbers.column(i, column.name()));
    out += "," + cell(joined(point.set)) + "," + cell(relative_to(root, outcome.directory)) + "," +
           cell(outcome.reason) + "\n";
  }
  return out;
}

std::string series_csv(const Report& report) {
  const auto& columns = report.plan.study.series_columns();
  std::string out = "series,done";
  for (const Column& column : columns) out += "," + cell(column.name());
  out += "\n";
  for (const Series& series : report.plan.study.series()) {
    out += cell(series.name()) + "," + std::to_string(finished_runs(report, series.name()));
    for (const Column& column : columns) out += "," + cell(report.numbers.of_series(series.name(), column));
    out += "\n";
  }
  return out;
}

std::string curves_csv(const Report& report, const Plot& plot) {
  std::string out = "curve,point,x,y\n";
  for (const Wanted& curve : wanted_curves(report, plot)) {
    const Expression x(curve.x);
    const Expression y(curve.y);
    if (plot.kind() == Plot::KIND_SERIES) {
      const Names* names = report.numbers.of(curve.on);
      if (names != nullptr) append_vertices(out, curve.label, curve.label, x.evaluate(*names), y.evaluate(*names));
      continue;
    }
    for (std::size_t i = 0; i < report.plan.points.size(); ++i) {
      const PlannedPoint& point = report.plan.points[i];
      const bool on_it = point.id == curve.on || point.series == curve.on;
      if (!on_it || report.outcomes[i].state != Outcome::State::done) continue;
      const Names& names = report.numbers.of_point(i);
      append_vertices(out, curve.label, point.name, x.evaluate(names), y.evaluate(names));
    }
  }
  return out;
}

std::string study_json(const Report& report, const fs::path& root) {
  const Study& study = report.plan.study;
  Json out = {{"title", study.title()},  {"results_version", orchestrator::results_version},
              {"points", Json::array()}, {"findings", Json::array()},
              {"plots", Json::array()},  {"snapshots", Json::array()}};
  for (std::size_t i = 0; i < report.plan.points.size(); ++i) out["points"].push_back(point_json(report, i, root));
  for (int i = 0; i < study.findings_size(); ++i) {
    out["findings"].push_back(finding_json(study.findings(i), report.verdicts[static_cast<std::size_t>(i)]));
  }
  for (const Plot& plot : study.plots()) out["plots"].push_back(plot_json(report, plot));
  for (const Snapshots& one : study.snapshots()) out["snapshots"].push_back(snapshots_json(report, one, root));
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_tables(const Report& report, const fs::path& root) {
  results::write_atomically(root / "table.csv", table_csv(report, root));
  if (report.plan.study.series_columns_size() > 0) {
    results::write_atomically(root / "series.csv", series_csv(report));
  }
  for (const Plot& plot : report.plan.study.plots()) {
    results::write_atomically(root / (plot.name() + ".csv"), curves_csv(report, plot));
  }
  results::write_atomically(root / "study.json", study_json(report, root));
}

}  // namespace grainstep::study
