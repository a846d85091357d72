#include "orchestrator/record/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace grainstep::orchestrator {
namespace {

using transport::Clock;

constexpr auto recent = std::chrono::seconds(30);
constexpr auto mark_interval = std::chrono::milliseconds(500);
constexpr auto bar_interval = std::chrono::milliseconds(250);
constexpr auto line_interval = std::chrono::seconds(8);
constexpr std::size_t bar_width = 30;

}  // namespace

void Rate::see(Clock::time_point now, std::uint64_t window) {
  if (!marks_.empty() && now - marks_.back().when < mark_interval) {
    return;
  }
  marks_.push_back({now, window});
  while (marks_.size() > 2 && now - marks_.front().when > recent) {
    marks_.pop_front();
  }
}

double Rate::per_second() const {
  if (marks_.size() < 2) {
    return 0.0;
  }
  const std::chrono::duration<double> elapsed = marks_.back().when - marks_.front().when;
  return static_cast<double>(marks_.back().window - marks_.front().window) / elapsed.count();
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::llround(seconds));
  if (whole < 60) {
    return std::to_string(whole) + " s";
  }
  if (whole < 3600) {
    return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  }
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

std::string moment_text(double seconds, double reference_time) {
  char out[48];
  if (std::isfinite(reference_time)) {
    std::snprintf(out, sizeof out, "t_bar %.4f", seconds / reference_time);
  } else {
    std::snprintf(out, sizeof out, "t %.4f ms", 1e3 * seconds);
  }
  return out;
}

Progress::Style Progress::style_for(std::FILE* stream, bool quiet) {
  if (quiet) {
    return Style::quiet;
  }
  return ::isatty(::fileno(stream)) != 0 ? Style::bar : Style::lines;
}

void Progress::tick(std::uint64_t window) {
  if (style_ == Style::quiet) {
    return;
  }
  const auto now = Clock::now();
  rate_.see(now, window);
  const bool due = style_ == Style::bar ? now - drawn_ >= bar_interval : now - drawn_ >= line_interval;
  if (due) {
    drawn_ = now;
    draw(window);
  }
}

void Progress::draw(std::uint64_t window) {
  const double part = static_cast<double>(window) / static_cast<double>(scale_.windows);
  const double rate = rate_.per_second();
  const std::string left = rate > 0.0
                               ? "about " + duration_text(static_cast<double>(scale_.windows - window) / rate) + " left"
                               : "time left not known yet";
  const std::string moment = moment_text(static_cast<double>(window) * scale_.window, scale_.reference_time);
  if (style_ == Style::bar) {
    const auto full = std::min(bar_width, static_cast<std::size_t>(part * bar_width));
    const std::string bar = std::string(full, '#') + std::string(bar_width - full, '.');
    std::fprintf(stream_, "\r[%s] %5.1f%%  %s  %s\033[K", bar.c_str(), 100.0 * part, moment.c_str(), left.c_str());
    open_line_ = true;
  } else {
    std::fprintf(stream_, "%5.1f%%  window %llu of %llu  %s  %s\n", 100.0 * part,
                 static_cast<unsigned long long>(window), static_cast<unsigned long long>(scale_.windows),
                 moment.c_str(), left.c_str());
  }
  std::fflush(stream_);
}

void Progress::finish() {
  if (open_line_) {
    std::fputc('\n', stream_);
    open_line_ = false;
  }
}

}  // namespace grainstep::orchestrator
