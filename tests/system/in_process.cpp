/// @file in-process SCENE OUT [PATH=VALUE...]: the same run as `grainstep run`, but both participants are threads of
/// this process and the messages never leave it. What processes and sockets do to a result is what differs from this.
#include <cstdio>
#include <memory>
#include <sstream>
#include <thread>

#include "base/error.hpp"
#include "dem-service/lammps/impactor.hpp"
#include "dem-service/native/impactor.hpp"
#include "fe-service/impactor.hpp"
#include "fe-service/structure.hpp"
#include "orchestrator/command/conduct.hpp"
#include "orchestrator/command/preparation.hpp"
#include "participant/serve.hpp"
#include "scene/load.hpp"
#include "scene/needs.hpp"
#include "transport/in_process_channel.hpp"

namespace {

/// That of the program which the scene names.
std::unique_ptr<grainstep::participant::ImpactorBackend> impactor_of(const grainstep::scene::Scene& scene) {
  using namespace grainstep;
  const std::string program = scene::program_of(scene, wire::IMPACTOR).command.front();
  if (program == "grainstep-dem") return dem::make_impactor({});
  if (program == "grainstep-grains") return dem::native::make_impactor();
  return std::make_unique<fe::Impactor>();
}

int run(const grainstep::orchestrator::RunOptions& options) {
  using namespace grainstep;
  const auto preparation =
      orchestrator::prepare_unasked(scene::load_scene(options.scene.scene, options.scene.set), options);
  const results::RunDirectory directory(options.out);
  const results::DirectoryLock lock = directory.prepare(results::Existing::refuse);
  auto [impactor, impactor_end] = transport::make_in_process_pair({.first = "orchestrator", .second = "impactor"});
  auto [structure, structure_end] = transport::make_in_process_pair({.first = "orchestrator", .second = "structure"});
  std::thread particles([&preparation, end = std::move(impactor_end)] {
    const std::unique_ptr<participant::ImpactorBackend> backend = impactor_of(preparation.scene);
    static_cast<void>(participant::serve_impactor(*end, *backend));
  });
  std::thread elements([end = std::move(structure_end)] {
    fe::Structure backend;
    static_cast<void>(participant::serve_structure(*end, backend));
  });
  orchestrator::EventLoop loop;
  orchestrator::Hub hub(*impactor, *structure, loop);
  const auto ending = orchestrator::conduct(
      hub, {.preparation = preparation, .directory = directory, .deadlines = {}, .account_of = {}});
  particles.join();
  elements.join();
  std::fputs(ending.reason.c_str(), stderr);
  return static_cast<int>(ending.code);
}

}  // namespace

int main(int argc, char** argv) {
  grainstep::orchestrator::RunOptions options;
  options.scene.scene = argv[1];
  options.out = argv[2];
  options.scene.set.assign(argv + 3, argv + argc);
  try {
    return run(options);
  } catch (const grainstep::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(grainstep::ExitCode::bad_input);
  }
}
