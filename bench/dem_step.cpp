/// @file What a step of the particles costs: the slug with our surface contact, mirror plane and ledger, in LAMMPS and
/// in the native engine, against the same slug in plain LAMMPS with two `fix wall/gran`. Runs alternate, so that all
/// see the same machine.
///     bench_dem_step [diameter in mm] [first step] [steps] [repetitions] [native|lammps|plain for one alone]
///                    [threads of the native one]
/// Times are CPU seconds of this process, or with more than one thread those of the clock; the median of the
/// repetitions counts.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../tests/unit/dem-service/engine_rig.hpp"
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

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, double otherwise) { return argc > i ? std::atof(argv[i]) : otherwise; };
  Job job;
  job.setup = rig::reference_setup();
  job.setup.set_mirror(true);
  scene::Slug& slug = rig::slug_of(job.setup);
  slug.set_half_width(0.1);
  slug.set_height(0.3);
  slug.mutable_particle()->set_diameter(argument(1, 1.0) * 1e-3);
  rig::set_flat_surface(job.setup, 0.5, 320);
  const SlugModel model = rig::model_of(job.setup);
  job.dt = model.preferred_step;
  job.warm_up = static_cast<std::uint64_t>(argument(2, 1500));
  job.steps = static_cast<std::uint64_t>(argument(3, 2000));
  const std::string only = argc > 5 ? argv[5] : "";
  job.threads = static_cast<int>(argument(6, 1));
  const std::pair<std::string, std::function<double()>> engines[] = {
      {"plain", [&job] { return plain(job); }},
      {"lammps", [&job] { return coupled(job, run_lammps); }},
      {"native", [&job] { return coupled(job, run_native); }}};
  std::map<std::string, std::vector<double>> times;
  for (int i = 0; i < static_cast<int>(argument(4, 3)); ++i) {
    for (const auto& [name, run] : engines) {
      if (only.empty() || only == name) times[name].push_back(run() * 1e9 / static_cast<double>(model.particles));
    }
  }
  std::printf("%llu particles, ns per particle and step:", static_cast<unsigned long long>(model.particles));
  for (const auto& [name, of_runs] : times) std::printf(" %s %.1f", name.c_str(), median(of_runs));
  std::printf("\n");
  return 0;
}
