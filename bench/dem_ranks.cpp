/// @file What a second MPI rank gains: a slice of a slug of spheres on a rigid disc, on all ranks of the job together
/// and on rank 0 alone, alternating. No structure, no messages, no other process.
///     mpirun -n RANKS bench_dem_ranks [diameter in mm] [end in t_hat] [repetitions] [parts]
/// Wall clock of each part of the event, shortest of the repetitions: how it is shared, and how evenly, changes with
/// it.
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <vector>

#include "../tests/unit/dem-service/slice_rig.hpp"

namespace {

using namespace grainstep;
using namespace grainstep::dem;

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Reads the clock at the end of every part.
class TimedLink final : public participant::ImpactorLink {
 public:
  TimedLink(rig::ScriptedLink& script, std::uint64_t part) : script_(script), part_(part) {}
  const wire::Kinematics* surface(std::uint64_t window) override {
    if ((window - 1) % part_ == 0) clock.push_back(now());
    return script_.surface(window);
  }
  participant::Due due(std::uint64_t window) const override { return script_.due(window); }
  void send(const wire::Forces&) override {}
  void send(wire::Report&) override {}
  void send(const wire::Snapshot&) override {}

  std::vector<double> clock;  ///< s

 private:
  rig::ScriptedLink& script_;
  std::uint64_t part_;
};

/// A rank that has nothing to do leaves its core alone.
void wait_for_all() {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  for (int done = 0; done == 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) usleep(1000);
}

struct Job {
  wire::Setup setup;
  wire::Start start;
  std::uint64_t part;  ///< windows
};

/// Seconds of every part, on rank 0; the others only help.
std::vector<double> run_on(MPI_Comm communicator, const Job& job) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  rig::ScriptedLink script(job.setup, job.start, rig::at_rest());
  TimedLink link(script, job.part);
  SlugEngine engine({.communicator = communicator, .lammps_log = {}}, job.setup);
  engine.run(job.start, rank == 0 ? &link : nullptr);
  link.clock.push_back(now());
  std::vector<double> seconds;
  for (std::size_t i = 1; i < link.clock.size(); ++i) seconds.push_back(link.clock[i] - link.clock[i - 1]);
  return seconds;
}

void keep_shortest(std::vector<double>& best, const std::vector<double>& seconds) {
  best.resize(seconds.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < best.size(); ++i) best[i] = std::min(best[i], seconds[i]);
}

struct Times {
  std::vector<double> alone, shared, at_once;  ///< s, every part
};

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

void print(const Job& job, double end, int ranks, const Times& times) {
  const auto particles = static_cast<double>(rig::model_of(job.setup).particles);
  const double steps = static_cast<double>(job.part) * job.start.impactor_steps();
  const auto parts = static_cast<double>(times.alone.size());
  const auto line = [&](const char* name, double alone, double shared, double at_once, double of) {
    const double scale = 1e9 / (particles * steps * of);
    std::printf("  %-10s %7.1f %10.1f %10.1f %8.2f %8.2f\n", name, scale * alone, scale * shared, scale * at_once,
                alone / shared, ranks * alone / at_once);
  };
  std::printf("%.0f spheres, %.0f steps, ns per sphere and step\n", particles, steps * parts);
  std::printf("  t_hat       1 rank    %d ranks  %d at once     gain  at most\n", ranks, ranks);
  for (std::size_t i = 0; i < times.alone.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "%.2f-%.2f", end / parts * static_cast<double>(i),
                  end / parts * static_cast<double>(i + 1));
    line(name, times.alone[i], times.shared[i], times.at_once[i], 1.0);
  }
  line("whole", sum(times.alone), sum(times.shared), sum(times.at_once), parts);
  std::printf("  %.2f s alone, %.2f s shared\n", sum(times.alone), sum(times.shared));
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, double otherwise) { return argc > i ? std::atof(argv[i]) : otherwise; };
  start_mpi();
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const double end = argument(2, 2.0);
  const auto parts = static_cast<std::uint64_t>(argument(4, 8.0));
  Job job{rig::plate_slug(argument(1, 1.0) * 1e-3), {}, 0};
  const SlugModel model = rig::model_of(job.setup);
  // Two steps a window, as `auto` takes them for the plate.
  const double window = 2.0 * model.preferred_step;
  job.part = static_cast<std::uint64_t>(end * model.height / model.speed / window / static_cast<double>(parts));
  job.start = rig::start_of(model.preferred_step, parts * job.part, 2);
  job.start.set_report_every(40);
  job.start.set_snapshot_every(0);
  Times times;
  for (int i = 0; i < static_cast<int>(argument(3, 1.0)); ++i) {
    wait_for_all();
    if (rank == 0) keep_shortest(times.alone, run_on(MPI_COMM_SELF, job));
    wait_for_all();
    keep_shortest(times.shared, run_on(MPI_COMM_WORLD, job));
    wait_for_all();
    keep_shortest(times.at_once, run_on(MPI_COMM_SELF, job));
  }
  if (rank == 0) print(job, end, ranks, times);
  MPI_Finalize();
  return 0;
}
