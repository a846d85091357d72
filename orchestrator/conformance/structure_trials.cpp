#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "ledger/observables.hpp"
#include "orchestrator/conformance/books.hpp"
#include "orchestrator/conformance/trial.hpp"

namespace grainstep::conformance {
namespace {

// A push that gives the surface about a metre per second in twenty steps, then nothing: m a = F with a tenth of the
// mass taken to follow. Its size matters little: nothing that is asked depends on it.
Plan pushed(const Subject& subject, unsigned steps = 1) {
  const wire::Ready& ready = subject.peer().ready;
  const double step = ready.preferred_step() < 1.0 ? ready.preferred_step() : 1e-6;
  const double mass = ready.mass() > 0.0 ? ready.mass() : 1.0;
  const double force = 0.1 * mass / (20.0 * steps * step);
  return {.windows = 40, .steps = steps, .force = [force](std::uint64_t n) {
            return n < 20 ? Vector{0.1 * force, -force, 0.0} : Vector{};
          }};
}

/// Runs with that plan; its forces need what the participant says of itself first, in a conversation of its own.
struct Pushed {
  explicit Pushed(const Bench& bench, unsigned steps = 1, double report_every = 1.0) {
    Subject asked(bench);
    asked.introduce();
    asked.prepare();
    Plan plan = pushed(asked, steps);
    plan.report_every = report_every;
    asked.stop();
    subject.emplace(bench);
    run.emplace(*subject, bench, plan);
    run->run();
  }
  std::optional<Subject> subject;
  std::optional<Played> run;
};

double largest(const google::protobuf::RepeatedField<double>& values) {
  double out = 0.0;
  for (const double value : values) out = std::max(out, std::abs(value));
  return out;
}

void rest(const Bench& bench) {
  Subject subject(bench);
  Played run(subject, bench, {});
  run.run();
  const wire::Surface& surface = subject.peer().ready.surface();
  if (largest(surface.velocity()) > 0.0) throw NotOffered("it moves at the start");
  const double size = largest(surface.position());
  for (const wire::Kinematics& now : run.kinematics) {
    for (int i = 0; i < now.position_size(); ++i) {
      const double way = std::abs(now.position(i) - surface.position(i));
      if (way <= 1e-12 * size) continue;
      throw Breach("without any force, a coordinate of its surface has moved by " + rounded_text(way) +
                   " m at window " + std::to_string(now.window()));
    }
  }
  for (const wire::Report& report : run.reports) {
    if (largest(report.momentum().linear()) > 0.0) throw Breach("without any force, it reports momentum");
  }
}

void motion(const Bench& bench) {
  const Pushed pushed(bench);
  const Played& run = *pushed.run;
  const double size = largest(pushed.subject->peer().ready.surface().position());
  for (std::size_t n = 1; n < run.kinematics.size(); ++n) {
    for (int i = 0; i < run.kinematics[n].position_size(); ++i) {
      const double way = run.kinematics[n].position(i) - run.kinematics[n - 1].position(i);
      const double told = run.kinematics[n].velocity(i) * run.window();
      if (std::abs(way - told) <= 1e-6 * std::abs(told) + 1e-12 * size) continue;
      throw Breach("at window " + std::to_string(n) + " a coordinate moved by " + rounded_text(way) +
                   " m, but the velocity sent with it times the window makes " + rounded_text(told) + " m");
    }
  }
}

void received(const Bench& bench) { require_interface_impulse(*Pushed(bench).run, 1.0, true); }

void unequal(const Bench& bench) {
  const Pushed pushed(bench, 4);
  require_interface_impulse(*pushed.run, 1.0, false);
  if (pushed.subject->peer().ready.ledger() == wire::FULL) require_momentum(*pushed.subject, *pushed.run);
}

void momentum(const Bench& bench) {
  const Pushed pushed(bench);
  require_momentum(*pushed.subject, *pushed.run);
}

void energy(const Bench& bench) {
  const Pushed pushed(bench);
  require_energy(*pushed.subject, *pushed.run);
}

/// Each impulse moves with the mean of the velocities before and after it.
void work(const Bench& bench) {
  const Pushed pushed(bench);
  const Played& run = *pushed.run;
  double scale = 0.0;
  double done = 0.0;
  std::vector<double> by_window;  // done up to t(n): half of window n's counts, with the velocity before it
  for (std::size_t n = 0; n < run.forces.size(); ++n) {
    double before = 0.0;
    double after = 0.0;
    for (int i = 0; i < run.forces[n].impulse_size(); ++i) {
      before += run.forces[n].impulse(i) * run.kinematics[n].velocity(i);
      if (n + 1 < run.kinematics.size()) after += run.forces[n].impulse(i) * run.kinematics[n + 1].velocity(i);
    }
    by_window.push_back(n == 0 ? 0.0 : done + 0.5 * before);
    done += 0.5 * ((n == 0 ? 0.0 : before) + after);
    scale = std::max(scale, std::abs(done));
  }
  for (const wire::Report& report : run.reports) {
    const double found = report.energy().interface_work();
    const double expected = by_window.at(report.window());
    if (std::abs(found - expected) <= 2.0 * of_integration * scale) continue;
    throw Breach("at window " + std::to_string(report.window()) + " interface_work is " + rounded_text(found) +
                 " J; the impulses and the velocities of its surface make " + rounded_text(expected) + " J");
  }
}

void free_body(const Bench& bench) {
  const Pushed pushed(bench);
  const double mass = pushed.subject->peer().ready.free_mass();
  if (!(mass > 0.0)) throw NotOffered("Ready.free_mass is 0: it is held, or deforms");
  const Played& run = *pushed.run;
  const Vector given = run.given_before(run.forces.size() - 1);
  const auto dimension = static_cast<int>(pushed.subject->dimension());
  for (int i = 0; i < run.kinematics.back().velocity_size(); ++i) {
    if (i % dimension != 1) continue;
    const double found = run.kinematics.back().velocity(i);
    const double expected = run.kinematics.front().velocity(i) + given[1] / mass;
    if (std::abs(found - expected) <= 1e-9 * std::abs(given[1] / mass)) continue;
    throw Breach("pushed with " + rounded_text(given[1]) + " N s it moves at " + rounded_text(found) +
                 " m/s along x2; its free_mass makes " + rounded_text(expected) + " m/s");
  }
}

void schedule(const Bench& bench) {
  Subject subject(bench);
  Played run(subject, bench, {.windows = 23, .report_every = 2.6, .snapshot_every = 7.3});
  run.run();
  if (run.snapshots.empty()) throw Breach("sent no snapshot");
}

}  // namespace

std::vector<Trial> structure_trials() {
  return {
      {"rest", "Nothing moves without force.", "Kinematics", rest},
      {"motion", "The surface moves as its velocities say.", "Kinematics", motion},
      {"received", "It takes up every impulse, half of it before and half after the end of the window.", "Forces",
       received},
      {"unequal", "With several of its steps in a window the impulse is the same.", "Steps", unequal},
      {"momentum", "Its momentum is what it received, to round-off.", "Report", momentum},
      {"energy", "Its energy is the work that was done on it.", "Report", energy},
      {"work", "It books the work that the impulses did on its surface.", "Report", work},
      {"free_body", "A free rigid body moves with its impulse over its mass.", "Ready", free_body},
      {"schedule", "Reports and snapshots come when they are due, with names and sizes that can be recorded.", "Order",
       schedule},
  };
}

}  // namespace grainstep::conformance
