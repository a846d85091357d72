#include "orchestrator/study/study_progress.hpp"

#include <algorithm>
#include <cstdio>

namespace grainstep::study {
namespace {

using transport::Clock;

constexpr auto bar_interval = std::chrono::seconds(1);
constexpr auto line_interval = std::chrono::seconds(30);
constexpr double too_early = 5.0;    // s; before that a rate says nothing
constexpr double too_little = 0.01;  // of a run
constexpr std::size_t most_names = 3;

}  // namespace

double Remaining::seconds(double elapsed, double work_done, double work_waiting, const std::vector<Active>& active) {
  double open = work_waiting;
  double slowest = 0.0;
  for (const Active& run : active) {
    work_done += run.fraction * run.estimate;
    open += (1.0 - run.fraction) * run.estimate;
    if (run.fraction > too_little) slowest = std::max(slowest, (1.0 - run.fraction) / run.fraction * run.elapsed);
  }
  if (elapsed < too_early || !(work_done > 0.0)) return -1.0;
  return std::max(slowest, open * elapsed / work_done);
}

bool StudyProgress::due() const {
  if (style_ == Style::quiet) return false;
  return Clock::now() - drawn_ >=
         (style_ == Style::bar ? Clock::duration(bar_interval) : Clock::duration(line_interval));
}

void StudyProgress::draw(std::size_t done, const std::vector<std::string>& active, double part, double seconds_left) {
  drawn_ = Clock::now();
  std::string names;
  for (std::size_t i = 0; i < std::min(active.size(), most_names); ++i) names += (i == 0 ? "" : ", ") + active[i];
  if (active.size() > most_names) names += ", ...";
  const std::string left =
      seconds_left < 0.0 ? "time left not known yet" : "about " + orchestrator::duration_text(seconds_left) + " left";
  const bool bar = style_ == Style::bar;
  std::printf("%s%5.1f%%  %zu of %zu runs done  [%s]  %s%s", bar ? "\r" : "", 100.0 * part, done, runs_, names.c_str(),
              left.c_str(), bar ? "\033[K" : "\n");
  open_line_ = bar;
  std::fflush(stdout);
}

void StudyProgress::say(const std::string& line) {
  if (style_ == Style::quiet) return;
  std::printf("%s%s\n", open_line_ ? "\r\033[K" : "", line.c_str());
  open_line_ = false;
  std::fflush(stdout);
}

void StudyProgress::finish() {
  if (open_line_) std::printf("\n");
  open_line_ = false;
  std::fflush(stdout);
}

}  // namespace grainstep::study
