/// @file What a step of the particles costs: the slug with our surface contact, mirror plane and ledger, in LAMMPS and
/// in the native engine, against the same slug in plain LAMMPS with two `fix wall/gran`. Runs alternate, so that all
/// see the same machine, each in a process of its own, as they are in use: what another one leaves of the heap costs.
///     bench_dem_step --diameter 1 --first 100 --steps 25500 --repetitions 3
/// Times are CPU seconds of this process, or with more than one thread those of the clock; the median of the
/// repetitions counts.
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../tests/unit/dem-service/engine_rig.hpp"
#include "../tests/unit/dem-service/slice_rig.hpp"
#include "bench/plain_slug.hpp"
#include "dem-service/native/impactor.hpp"

namespace {

using namespace grainstep;
using namespace grainstep::dem;

struct Job {
  wire::Setup setup;
  double dt = 0.0;
  std::uint64_t warm_up = 0;
  std::uint64_t steps = 0;
  int threads = 1;
};

double seconds(const Job& job) {
  timespec now{};
  clock_gettime(job.threads > 1 ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Reads the clock when the warm-up is over.
class TimedLink final : public participant::ImpactorLink {
 public:
  TimedLink(const Job& job, rig::ScriptedLink& script) : job_(job), script_(script) {}
  const wire::Kinematics* surface(std::uint64_t window) override {
    if (window == job_.warm_up) began_ = seconds(job_);
    return script_.surface(window);
  }
  participant::Due due(std::uint64_t window) const override { return script_.due(window); }
  void send(const wire::Forces&) override {}
  void send(wire::Report&) override {}
  void send(const wire::Snapshot&) override {}
  double began() const { return began_; }

 private:
  const Job& job_;
  rig::ScriptedLink& script_;
  double began_ = 0.0;
};

void run_lammps(const Job& job, const wire::Start& start, participant::ImpactorLink& link) {
  SlugEngine(rig::alone(), job.setup).run(start, &link);
}

void run_native(const Job& job, const wire::Start& start, participant::ImpactorLink& link) {
  const auto impactor = native::make_impactor(job.threads);
  static_cast<void>(impactor->prepare(job.setup));
  impactor->run(start, link);
}

using Engine = void (*)(const Job& job, const wire::Start& start, participant::ImpactorLink& link);

double coupled(const Job& job, Engine engine) {
  wire::Start start = rig::start_of(job.dt, job.warm_up + job.steps);
  start.set_report_every(100);
  start.set_snapshot_every(0);
  rig::ScriptedLink script(job.setup, start, rig::at_rest());
  TimedLink link(job, script);
  engine(job, start, link);
  return (seconds(job) - link.began()) / static_cast<double>(job.steps);
}

double plain(const Job& job) {
  bench::PlainSlug slug(rig::model_of(job.setup), job.dt);
  slug.run(job.warm_up);
  const double began = seconds(job);
  slug.run(job.steps);
  return (seconds(job) - began) / static_cast<double>(job.steps);
}

/// What `run` returns, computed by a child.
double in_a_process_of_its_own(const std::function<double()>& run) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    const double found = run();
    ::_exit(::write(ends[1], &found, sizeof found) == sizeof found ? 0 : 1);
  }
  ::close(ends[1]);
  double found = 0.0;
  const bool said = ::read(ends[0], &found, sizeof found) == sizeof found;
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  if (!said) throw std::runtime_error("a run did not come to its end");
  return found;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The small scene's discs before a rigid wall, with a mirror.
wire::Setup discs(double diameter) {
  wire::Setup setup = rig::reference_setup();
  setup.set_mirror(true);
  scene::Slug& slug = rig::slug_of(setup);
  slug.set_half_width(0.1);
  slug.set_height(0.3);
  slug.mutable_particle()->set_diameter(diameter);
  rig::set_flat_surface(setup, 0.5, 320);
  return setup;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Nanoseconds per particle and step");
  double diameter = 1.0;
  int repetitions = 3;
  bool of_spheres = false;
  std::vector<std::string> only;
  Job job;
  job.warm_up = 1500;
  job.steps = 2000;
  app.add_option("--diameter", diameter, "mm")->capture_default_str();
  app.add_flag("--spheres", of_spheres, "Spheres in a slice instead of discs; plain LAMMPS has no part in it");
  app.add_option("--first", job.warm_up, "Steps before those that count")->capture_default_str();
  app.add_option("--steps", job.steps, "Steps that count")->capture_default_str();
  app.add_option("--repetitions", repetitions, "Runs of each, in turn")->capture_default_str();
  app.add_option("--engine", only, "plain, lammps, native: these alone");
  app.add_option("--threads", job.threads, "Of the native engine")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  job.setup = of_spheres ? rig::plate_slug(diameter * 1e-3) : discs(diameter * 1e-3);
  const SlugModel model = rig::model_of(job.setup);
  job.dt = model.preferred_step;
  const std::pair<std::string, std::function<double()>> engines[] = {
      {"plain", [&job] { return plain(job); }},
      {"lammps", [&job] { return coupled(job, run_lammps); }},
      {"native", [&job] { return coupled(job, run_native); }}};
  std::map<std::string, std::vector<double>> times;
  for (int i = 0; i < repetitions; ++i) {
    for (const auto& [name, run] : engines) {
      if (of_spheres && name == "plain") continue;
      if (!only.empty() && std::find(only.begin(), only.end(), name) == only.end()) continue;
      times[name].push_back(in_a_process_of_its_own(run) * 1e9 / static_cast<double>(model.particles));
    }
  }
  std::printf("%llu particles, ns per particle and step:", static_cast<unsigned long long>(model.particles));
  for (const auto& [name, of_runs] : times) std::printf(" %s %.1f", name.c_str(), median(of_runs));
  std::printf("\n");
  return 0;
}
