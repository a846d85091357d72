#include "orchestrator/record/surface_record.hpp"

#include <google/protobuf/util/json_util.h>

#include <chrono>
#include <string>

#include "base/error.hpp"
#include "ledger/ledger.hpp"
#include "replay/format.hpp"
#include "scene/groups.hpp"
#include "scene/needs.hpp"

namespace grainstep::orchestrator {
namespace {

namespace dataset = replay::dataset;
using results::h5::Packing;

// Every burst is written and packed twice (twin_file.hpp): few large ones.
constexpr auto burst_interval = std::chrono::seconds(10);
constexpr std::size_t burst_bytes = std::size_t{64} << 20U;

std::string json_of(const record::About& about) {
  std::string out;
  const auto written = google::protobuf::util::MessageToJsonString(about, &out);
  if (!written.ok()) throw OutputError("output.record: " + std::string(written.message()));
  return out;
}

results::Contents contents_after(std::uint64_t window) {
  results::Contents out{
      {dataset::about, 0}, {dataset::facet, 0}, {dataset::impactor_energy, 0}, {dataset::impactor_momentum, 0}};
  for (const char* rows : {dataset::time, dataset::impulse, dataset::position, dataset::velocity})
    out[rows] = window + 1;
  return out;
}

}  // namespace

record::About about_record(const scene::Scene& scene, std::uint64_t hash, double window) {
  record::About about;
  about.set_title(scene.title());
  about.set_scene_hash(hash);
  about.set_symmetry(scene.symmetry());
  about.set_depth(scene.depth());
  about.set_mirror(scene::has_mirror(scene));
  about.set_dimension(scene::surface_dimension(scene));
  about.set_window(window);
  if (scene::has_slug(scene)) about.set_impactor_speed(scene.impactor().slug().speed());
  return about;
}

SurfaceRecord::SurfaceRecord(const std::filesystem::path& file, const record::About& about)
    : about_(about), file_(file, {{dataset::about, "what was recorded, as JSON (record.proto)", json_of(about)}}) {
  begin();
  const wire::Surface& surface = about_.structure().surface();
  file_.add(results::Array{.dataset = dataset::facet,
                           .meaning = {"", "nodes of every segment or triangle of the surface"},
                           .columns = about_.dimension(),
                           .values = {},
                           .indices = {surface.facet().begin(), surface.facet().end()}});
}

SurfaceRecord::SurfaceRecord(const std::filesystem::path& file, const record::About& about, std::uint64_t window)
    : about_(about), file_(results::ResultsFile::GoOn{}, file, contents_after(window)) {
  begin();
}

void SurfaceRecord::begin() {
  const wire::Surface& surface = about_.structure().surface();
  position_.assign(surface.position().begin(), surface.position().end());
  velocity_.assign(surface.velocity().begin(), surface.velocity().end());
  velocity_.resize(position_.size(), 0.0);
}

void SurfaceRecord::first_report(const wire::Report& impactor) {
  const auto& momentum = impactor.momentum().linear();
  file_.add(results::Array{.dataset = dataset::impactor_energy,
                           .meaning = {"J", "the impactor's at the start"},
                           .values = {ledger::energy_of(impactor.energy())},
                           .indices = {}});
  file_.add(results::Array{.dataset = dataset::impactor_momentum,
                           .meaning = {"N s", "the impactor's at the start"},
                           .values = {momentum.begin(), momentum.end()},
                           .indices = {}});
}

void SurfaceRecord::kinematics(const wire::Kinematics& kinematics) {
  position_.assign(kinematics.position().begin(), kinematics.position().end());
  velocity_.assign(kinematics.velocity().begin(), kinematics.velocity().end());
}

void SurfaceRecord::forces(const wire::Forces& forces) {
  const double time = static_cast<double>(forces.window()) * about_.window();
  file_.add({{.dataset = dataset::time, .meaning = {"s", "end of the window"}, .value = time}});
  file_.add(results::Line{.dataset = dataset::impulse,
                          .meaning = {"N s", "given to the surface's nodes in the window that ends then"},
                          .values = {forces.impulse().begin(), forces.impulse().end()},
                          .packing = Packing::packed});
  file_.add(results::Line{.dataset = dataset::position,
                          .meaning = {"m", "of the surface's nodes then"},
                          .values = position_,
                          .packing = Packing::packed});
  file_.add(results::Line{.dataset = dataset::velocity,
                          .meaning = {"m/s", "mean over the window that ends then; at the start the initial one"},
                          .values = velocity_,
                          .packing = Packing::packed});
}

void SurfaceRecord::flush_if_due() {
  if (file_.pending_bytes() < burst_bytes && transport::Clock::now() - flushed_ < burst_interval) return;
  flush();
}

void SurfaceRecord::flush() {
  file_.flush();
  flushed_ = transport::Clock::now();
}

}  // namespace grainstep::orchestrator
