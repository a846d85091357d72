/// @file How far a run is: a bar on a terminal, a plain line now and then elsewhere. The time left comes from the rate
/// over the recent past, because a slug costs more while it compacts than before.
#pragma once

#include <cstdint>
#include <cstdio>
#include <deque>
#include <string>

#include "transport/channel.hpp"

namespace grainstep::orchestrator {

/// Windows per second over the last half minute. Pure, told the time.
class Rate {
 public:
  void see(transport::Clock::time_point now, std::uint64_t window);
  [[nodiscard]] double per_second() const;  ///< 0: not known yet

 private:
  struct Mark {
    transport::Clock::time_point when;
    std::uint64_t window;
  };
  std::deque<Mark> marks_;
};

/// "about 3 min 20 s", "about 12 s".
[[nodiscard]] std::string duration_text(double seconds);

/// A time of a run: "t_bar 0.3021", or "t 0.3021 ms" where the scene has no reference time (s).
[[nodiscard]] std::string moment_text(double seconds, double reference_time);

class Progress {
 public:
  enum class Style { quiet, lines, bar };
  [[nodiscard]] static Style style_for(std::FILE* stream, bool quiet);

  /// `window` of so many windows, s; `reference_time`, s, as for moment_text().
  struct Scale {
    std::uint64_t windows;
    double window;
    double reference_time;
  };
  Progress(std::FILE* stream, Style style, const Scale& scale) : stream_(stream), style_(style), scale_(scale) {}

  void tick(std::uint64_t window);
  void finish();  ///< ends the bar's line

 private:
  void draw(std::uint64_t window);

  std::FILE* stream_;
  Style style_;
  Scale scale_;
  Rate rate_;
  transport::Clock::time_point drawn_ = transport::Clock::now();
  bool open_line_ = false;
};

}  // namespace grainstep::orchestrator
