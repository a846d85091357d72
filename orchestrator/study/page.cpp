#include "orchestrator/study/page.hpp"

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "orchestrator/record/summary.hpp"
#include "results/atomic_file.hpp"
#include "results/hdf5.hpp"
#include "results/run_directory.hpp"

namespace grainstep::study {
namespace {

namespace fs = std::filesystem;

/// Of a table: no line ends, no columns.
std::string escaped(std::string text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  return out;
}

std::string with_unit(const std::string& figure, const std::string& unit) {
  return unit.empty() || figure == "-" ? figure : unit == "%" ? figure + "%" : figure + " " + unit;
}

bool any_finding(const Study& study, bool asserted) {
  return std::any_of(study.findings().begin(), study.findings().end(), [asserted](const Finding& finding) {
    return asserted == (finding.has_expected() || finding.has_at_least() || finding.has_at_most());
  });
}

std::string difference(const Finding& finding, const Verdict& verdict) {
  if (!finding.has_expected() || verdict.state == Verdict::State::open) return "";
  const double off = verdict.value - finding.expected();
  return finding.expected() == 0.0 ? figure(off, 3) : figure(100.0 * off / std::abs(finding.expected()), 3) + "%";
}

std::string stated(const Report& report) {
  const Study& study = report.plan.study;
  if (!any_finding(study, true)) return "";
  std::string out =
      "## What is stated, and what comes out\n\n| statement | source | stated | found | difference | "
      "|\n|---|---|---|---|---|---|\n";
  std::string reasons;
  for (int i = 0; i < study.findings_size(); ++i) {
    const Finding& finding = study.findings(i);
    const Verdict& verdict = report.verdicts[static_cast<std::size_t>(i)];
    if (verdict.wanted.empty()) continue;
    out += "| " + escaped(finding.statement()) + " | " + escaped(finding.source()) + " | " + verdict.wanted + " | " +
           with_unit(figure(verdict.value, 4), finding.unit()) + " | " + difference(finding, verdict) + " | " +
           (verdict.state == Verdict::State::fails ? "**does not hold**" : state_name(verdict.state)) + " |\n";
    if (!finding.reason().empty()) reasons += "- " + finding.statement() + ": " + finding.reason() + "\n";
  }
  return out + (reasons.empty() ? "" : "\n" + reasons) + "\n";
}

std::string reported(const Report& report) {
  const Study& study = report.plan.study;
  if (!any_finding(study, false)) return "";
  std::string out = "## Figures\n\n| what | of | value | |\n|---|---|---|---|\n";
  for (int i = 0; i < study.findings_size(); ++i) {
    const Finding& finding = study.findings(i);
    const Verdict& verdict = report.verdicts[static_cast<std::size_t>(i)];
    if (!verdict.wanted.empty()) continue;
    out += "| " + escaped(finding.statement()) + " | " + escaped(finding.on()) + " | " +
           with_unit(figure(verdict.value, 4), finding.unit()) + " | " + escaped(finding.reason()) + " |\n";
  }
  return out + "\n";
}

using Columns = google::protobuf::RepeatedPtrField<Column>;

/// The head of a table whose first columns are `first`, and the line below it.
std::string head(const std::vector<std::string>& first, const Columns& columns) {
  std::string out = "|";
  std::string line = "|";
  const auto add = [&](const std::string& title) {
    out += " " + title + " |";
    line += "---|";
  };
  for (const std::string& title : first) add(title);
  for (const Column& column : columns) {
    if (column.hidden()) continue;
    const std::string title = column.title().empty() ? column.name() : column.title();
    add(escaped(title + (column.unit().empty() ? "" : ", " + column.unit())));
  }
  return out + "\n" + line + "\n";
}

std::string cells(const Columns& columns, const std::function<double(const Column&)>& value) {
  std::string out;
  for (const Column& column : columns) {
    if (!column.hidden()) out += " " + figure(value(column), static_cast<int>(column.digits())) + " |";
  }
  return out + "\n";
}

std::string series_table(const Report& report) {
  const Columns& columns = report.plan.study.series_columns();
  if (columns.empty()) return "";
  std::string out = "## Series\n\n" + head({"series", "runs"}, columns);
  for (const Series& series : report.plan.study.series()) {
    out += "| " + escaped(series.name()) + " | " + std::to_string(finished_runs(report, series.name())) + " |" +
           cells(columns, [&](const Column& column) { return report.numbers.of_series(series.name(), column); });
  }
  return out + "\n";
}

std::string note_on(const Outcome& outcome) {
  switch (outcome.state) {
    case Outcome::State::done:
      return "";
    case Outcome::State::failed:
      return " (failed: " + outcome.reason + ")";
    case Outcome::State::postponed:
      return " (needs --long, not run)";
    case Outcome::State::open:
      break;
  }
  return " (not run)";
}

std::string run_table(const Report& report) {
  const Columns& columns = report.plan.study.columns();
  std::string out = "## Runs\n\n" + head({"series", "point"}, columns);
  for (std::size_t i = 0; i < report.plan.points.size(); ++i) {
    const PlannedPoint& point = report.plan.points[i];
    out += "| " + escaped(point.series) + " | " + escaped(point.name + note_on(report.outcomes[i])) + " |" +
           cells(columns, [&](const Column& column) { return report.numbers.column(i, column.name()); });
  }
  return out;
}

/// The commit of the build that made a run, with a "+" where its tree was not committed; empty where the file does not
/// say.
std::string commit_of(const Outcome& outcome) {
  try {
    const auto file = results::h5::File::read(results::RunDirectory(outcome.directory).results());
    return file.has("/build/commit") ? file.read_text("/build/commit") : "";
  } catch (const OutputError&) {  // moved or removed since; its summary was read
    return "";
  }
}

/// What the finished runs were made with.
std::string origin_of_runs(const Report& report) {
  std::set<fs::path> runs;
  std::set<std::string> commits;
  double wall = 0.0;
  for (const Outcome& outcome : report.outcomes) {
    if (outcome.state != Outcome::State::done || !runs.insert(outcome.directory).second) continue;
    commits.insert(commit_of(outcome));
    wall += outcome.summary.value("wall_seconds", 0.0);
  }
  commits.erase("");
  std::string out = std::to_string(runs.size()) + (runs.size() == 1 ? " run" : " runs") + ", " +
                    figure(wall / 60.0, 3) + " minutes of wall clock if one after the other";
  for (const std::string& commit : commits) out += (commit == *commits.begin() ? "; commit " : ", ") + commit;
  return out + "; results version " + std::to_string(orchestrator::results_version) + ".\n";
}

}  // namespace

std::string page_markdown(const Report& report, const std::string& command,
                          const std::function<std::string(const std::string&)>& picture_of) {
  const Study& study = report.plan.study;
  std::string out = "# " + study.title() + "\n\n<!-- Written by grainstep study; do not edit. -->\n\n";
  if (!study.text().empty()) out += study.text() + (study.text().ends_with('\n') ? "\n" : "\n\n");
  const auto show = [&](const std::string& name, const std::string& title) {
    const std::string picture = picture_of(name);
    if (!picture.empty()) out += "![" + (title.empty() ? study.title() : title) + "](" + picture + ")\n\n";
  };
  for (const Snapshots& snapshots : study.snapshots()) show(snapshots.name(), snapshots.title());
  for (const Plot& plot : study.plots()) show(plot.name(), plot.title());
  out += stated(report) + reported(report) + series_table(report) + run_table(report);
  return out + "\nMade by `" + command + "`: " + origin_of_runs(report);
}

void write_page(const Report& report, const fs::path& root, const fs::path& page, const std::string& command) {
  const auto picture_of = [&](const std::string& name) -> std::string {
    const fs::path drawn = root / (name + ".png");
    std::error_code error;
    if (!fs::exists(drawn, error)) return "";
    const std::string suffix = name == "plot" ? "" : "-" + name;
    const fs::path link = fs::path("images") / (page.stem().string() + suffix + ".png");
    fs::create_directories((page.parent_path() / link).parent_path(), error);
    fs::copy_file(drawn, page.parent_path() / link, fs::copy_options::overwrite_existing, error);
    if (error) throw OutputError((page.parent_path() / link).string() + ": cannot be written: " + error.message());
    return link.string();
  };
  results::write_atomically(page, page_markdown(report, command, picture_of));
}

}  // namespace grainstep::study
