/// @file How far a study is, and an honest time left.
#pragma once

#include <string>
#include <vector>

#include "orchestrator/record/progress.hpp"
#include "transport/channel.hpp"

namespace grainstep::study {

/// Work in seconds as `check` estimates it; only its proportions count, because the rate is measured. Pure, told the
/// time.
class Remaining {
 public:
  struct Active {
    double estimate = 0.0;  ///< s
    double fraction = 0.0;  ///< done, 0 to 1
    double elapsed = 0.0;   ///< s
  };

  /// Seconds left: what is not done at the rate so far, but no less than the slowest run in progress needs at its own;
  /// negative: not known yet.
  [[nodiscard]] static double seconds(double elapsed, double work_done, double work_waiting,
                                      const std::vector<Active>& active);
};

class StudyProgress {
 public:
  using Style = orchestrator::Progress::Style;
  explicit StudyProgress(Style style, std::size_t runs) : style_(style), runs_(runs) {}

  /// Whether it is time to draw again; cheap.
  [[nodiscard]] bool due() const;
  void draw(std::size_t done, const std::vector<std::string>& active, double part, double seconds_left);
  /// A line of its own, also on a terminal with a bar.
  void say(const std::string& line);
  void finish();

 private:
  Style style_;
  std::size_t runs_;
  transport::Clock::time_point drawn_ = transport::Clock::now();
  bool open_line_ = false;
};

}  // namespace grainstep::study
