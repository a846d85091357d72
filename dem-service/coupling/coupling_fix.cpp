#include "dem-service/coupling/coupling_fix.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "dem-service/deck/deck_particles.hpp"
#include "dem-service/lammps/attach.hpp"
#include "dem-service/lammps/pair_style.hpp"
#include "participant/connect.hpp"
#include "participant/hello.hpp"
#include "participant/serve.hpp"
#include "surface/disc_overlap.hpp"

namespace grainstep::dem {
namespace {

void broadcast(google::protobuf::MessageLite& message, MPI_Comm communicator) {
  std::string bytes = message.SerializeAsString();
  auto size = static_cast<int>(bytes.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, communicator);
  bytes.resize(static_cast<std::size_t>(size));
  MPI_Bcast(bytes.data(), size, MPI_CHAR, 0, communicator);
  if (!message.ParseFromString(bytes)) throw PeerError("rank 0", "passed on a damaged message");
}

SlugModel model_of(const wire::Setup& setup, const DeckParticles& particles) {
  const wire::ImpactorSetup& part = setup.impactor();
  SlugModel model = make_deck_model(part.impactor().deck().contact(), particles);
  if (!part.surface().facet().empty()) {
    meet(model, {}, part.free_mass(), mean_length(MovingSurface(part.surface()).now()));
  }
  return model;
}

}  // namespace

wire::Hello Rendezvous::describe() const {
  wire::Hello hello = participant::hello(wire::IMPACTOR, "LAMMPS with fix grainstep/coupling", GRAINSTEP_VERSION, {2});
  for (const char* word : {"deck", "plane_strain"}) hello.add_capabilities(word);
  return hello;
}

wire::Ready Rendezvous::prepare(const wire::Setup& setup) {
  if (!setup.has_impactor())
    throw InputError("setup: fix grainstep/coupling is an impactor, but was sent a structure's part");
  require_deck_scene(setup);
  const SlugModel model = model_of(setup, particles_);
  wire::Ready ready = ready_of(model, particles_);
  ready.set_scene_hash(setup.scene_hash());
  const std::lock_guard lock(mutex_);
  setup_ = setup;
  return ready;
}

void Rendezvous::run(const wire::Start& start, participant::ImpactorLink& link) {
  std::unique_lock lock(mutex_);
  start_ = start;
  link_ = &link;
  changed_.notify_all();
  changed_.wait(lock, [this] { return left_; });
  link_ = nullptr;
  if (failure_) std::rethrow_exception(failure_);
}

participant::ImpactorLink* Rendezvous::wait_for_start(wire::Setup& setup, wire::Start& start) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return link_ != nullptr || closed_; });
  setup = setup_;
  start = start_;
  return link_;
}

void Rendezvous::leave(std::exception_ptr failure) {
  const std::lock_guard lock(mutex_);
  left_ = true;
  failure_ = std::move(failure);
  changed_.notify_all();
}

void Rendezvous::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

CouplingFix::CouplingFix(lammps::Instance* lammps, int argument_count, char** arguments)
    : SurfaceFix(lammps, argument_count, arguments) {
  if (argument_count != 4) refuse("fix grainstep/coupling: expected `fix ID all grainstep/coupling ENDPOINT`");
  endpoint_ = arguments[3];
}

CouplingFix::~CouplingFix() { end(); }

void CouplingFix::init() {
  if (driver_of_run_) refuse("fix grainstep/coupling: one run is all that it takes part in");
  try {
    meet_orchestrator();
  } catch (const std::exception& reason) {
    end();
    refuse(std::string("fix grainstep/coupling: ") + reason.what());
  }
}

void CouplingFix::meet_orchestrator() {
  const DeckParticles particles = deck_particles(instance(), communicator());
  wire::Setup setup;
  wire::Start start;
  participant::ImpactorLink* link = nullptr;
  int met = 0;
  if (rank() == 0) {
    rendezvous_.emplace(particles);
    conversation_ = std::thread([this] {
      try {
        const auto channel = participant::open({.endpoint = endpoint_});
        static_cast<void>(participant::serve_impactor(*channel, *rendezvous_));
      } catch (const std::exception& reason) {
        std::fprintf(stderr, "fix grainstep/coupling: %s\n", reason.what());
      }
      rendezvous_->close();
    });
    link = rendezvous_->wait_for_start(setup, start);
    met = link != nullptr ? 1 : 0;
  }
  MPI_Bcast(&met, 1, MPI_INT, 0, communicator());
  if (met == 0) throw PeerError("orchestrator", "ended the conversation before the run began; it says why");
  broadcast(setup, communicator());
  broadcast(start, communicator());
  require_beginning(start);
  require_drivable(start);
  model_ = model_of(setup, particles);
  const double dt = start.window() / start.impactor_steps();
  set_step(dt);
  MovingSurface surface(setup.impactor().surface());
  exchange_of_run_.emplace(communicator(), link, surface.node_count());
  driver_of_run_.emplace(model_, start, StepSettings{dt, skin() / 2.0}, std::move(surface), *exchange_of_run_);
  connect(*driver_of_run_, *exchange_of_run_, particles.own_pair_style);
}

// LAMMPS's run is over: by the driver, at the last window or where the other side ended it, or by its own count.
void CouplingFix::post_run() {
  std::exception_ptr failure;
  try {
    if (exchange_of_run_) exchange_of_run_->finish();
  } catch (...) {
    failure = std::current_exception();
  }
  if (rendezvous_) rendezvous_->leave(failure);
  end();
}

void CouplingFix::end() {
  if (rendezvous_) rendezvous_->leave(nullptr);
  if (conversation_.joinable()) conversation_.join();
}

}  // namespace grainstep::dem
