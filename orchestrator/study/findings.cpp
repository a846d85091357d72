#include "orchestrator/study/findings.hpp"

#include <cmath>
#include <set>

#include "base/number_text.hpp"

namespace grainstep::study {
namespace {

constexpr int digits = 4;

std::string wanted(const Finding& finding) {
  std::string out;
  if (finding.has_expected()) {
    out = figure(finding.expected(), digits) + " +- ";
    out += finding.expected() == 0.0 ? figure(finding.tolerance(), 3) : figure(100.0 * finding.tolerance(), 3) + "%";
  }
  if (finding.has_at_least())
    out += (out.empty() ? "" : ", ") + std::string("at least ") + figure(finding.at_least(), digits);
  if (finding.has_at_most())
    out += (out.empty() ? "" : ", ") + std::string("at most ") + figure(finding.at_most(), digits);
  return out;
}

/// NaN is nowhere inside.
bool inside(const Finding& finding, double value) {
  const double scale = finding.expected() == 0.0 ? 1.0 : std::abs(finding.expected());
  const bool near = !finding.has_expected() || std::abs(value - finding.expected()) <= finding.tolerance() * scale;
  const bool above = !finding.has_at_least() || value >= finding.at_least();
  const bool below = !finding.has_at_most() || value <= finding.at_most();
  return std::isfinite(value) && near && above && below;
}

/// Whether any run that the finding looks at is still to come. Of a series, points that are long and were not asked for
/// do not count: a finding on a series is about those that are there.
bool is_open(const Plan& plan, const std::vector<Outcome>& outcomes, const Finding& finding) {
  std::set<std::string> places = {finding.on()};
  Expression(finding.value()).visit([&](const std::string&, const std::string& where) { places.insert(where); });
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    const PlannedPoint& point = plan.points[i];
    const auto state = outcomes[i].state;
    if (places.contains(point.id) && (state == Outcome::State::open || state == Outcome::State::postponed)) return true;
    if (places.contains(point.series) && state == Outcome::State::open) return true;
  }
  return false;
}

bool touches_failure(const Plan& plan, const std::vector<Outcome>& outcomes, const Finding& finding) {
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    const bool looked_at = plan.points[i].id == finding.on() || plan.points[i].series == finding.on();
    if (looked_at && outcomes[i].state == Outcome::State::failed) return true;
  }
  return false;
}

Verdict verdict(const Plan& plan, const std::vector<Outcome>& outcomes, const Numbers& numbers,
                const Finding& finding) {
  Verdict out;
  out.wanted = wanted(finding);
  if (is_open(plan, outcomes, finding)) return out;
  if (const Names* names = numbers.of(finding.on())) out.value = Expression(finding.value()).number(*names);
  const bool failed = touches_failure(plan, outcomes, finding) || (!out.wanted.empty() && !inside(finding, out.value));
  out.state = failed ? Verdict::State::fails : out.wanted.empty() ? Verdict::State::reported : Verdict::State::holds;
  return out;
}

}  // namespace

const char* state_name(Verdict::State state) {
  switch (state) {
    case Verdict::State::holds:
      return "holds";
    case Verdict::State::fails:
      return "FAILS";
    case Verdict::State::reported:
      return "reported";
    case Verdict::State::open:
      break;
  }
  return "open";
}

std::vector<Verdict> judge(const Plan& plan, const std::vector<Outcome>& outcomes, const Numbers& numbers) {
  std::vector<Verdict> out;
  for (const Finding& finding : plan.study.findings()) out.push_back(verdict(plan, outcomes, numbers, finding));
  return out;
}

}  // namespace grainstep::study
