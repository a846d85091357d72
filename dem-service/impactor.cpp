#include "dem-service/impactor.hpp"

#include <unistd.h>

#include <fstream>
#include <iterator>

#include "base/assert.hpp"
#include "base/error.hpp"
#include "dem-service/mpi_start.hpp"
#include "dem-service/slug_engine.hpp"

namespace grainstep::dem {
namespace {

/// What rank 0 tells the others to do next.
enum class Order : int { prepare, run, leave };

EngineOptions completed(EngineOptions options) {
  start_mpi();
  if (options.communicator == MPI_COMM_NULL) options.communicator = MPI_COMM_SELF;
  return options;
}

void broadcast(std::string& bytes, MPI_Comm communicator) {
  auto size = static_cast<int>(bytes.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, communicator);
  bytes.resize(static_cast<std::size_t>(size));
  MPI_Bcast(bytes.data(), size, MPI_CHAR, 0, communicator);
}

void give(Order order, std::string bytes, MPI_Comm communicator) {
  int word = static_cast<int>(order);
  MPI_Bcast(&word, 1, MPI_INT, 0, communicator);
  if (order != Order::leave) broadcast(bytes, communicator);
}

std::uint64_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t total = 0;
  std::uint64_t resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t resident_bytes_of_all(MPI_Comm communicator) {
  const std::uint64_t mine = resident_bytes();
  std::uint64_t all = mine;
  MPI_Reduce(&mine, &all, 1, MPI_UINT64_T, MPI_SUM, 0, communicator);
  return all;
}

class Impactor final : public participant::ImpactorBackend {
 public:
  explicit Impactor(const EngineOptions& options) : options_(completed(options)) {}
  ~Impactor() override {
    give(Order::leave, {}, options_.communicator);
    engine_.reset();
  }
  Impactor(const Impactor&) = delete;
  Impactor& operator=(const Impactor&) = delete;
  Impactor(Impactor&&) = delete;
  Impactor& operator=(Impactor&&) = delete;

  [[nodiscard]] wire::Hello describe() const override {
    wire::Hello hello;
    hello.set_protocol(wire::PROTOCOL_VERSION);
    hello.set_role(wire::IMPACTOR);
    hello.set_backend("grainstep-dem (LAMMPS)");
    hello.set_version(GRAINSTEP_VERSION);
    hello.set_dimension(2);
    hello.add_capabilities("slug");
    hello.set_process(static_cast<std::uint64_t>(getpid()));
    return hello;
  }

  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    give(Order::prepare, setup.SerializeAsString(), options_.communicator);
    engine_.reset();
    engine_ = std::make_unique<SlugEngine>(options_, setup);
    const SlugModel& model = engine_->model();
    wire::Ready ready;
    ready.set_scene_hash(setup.scene_hash());
    ready.set_stable_step(model.stable_step);
    ready.set_preferred_step(model.preferred_step);
    ready.set_size(model.particles);
    ready.set_mass(model.mass_of_all());
    ready.set_contact_mass(model.whole() * model.mass_of(model.largest()));
    ready.set_contact_time(model.contact_time);
    ready.set_memory(resident_bytes_of_all(options_.communicator));
    return ready;
  }

  void run(const wire::Start& start, participant::ImpactorLink& link) override {
    GS_ASSERT(engine_ != nullptr, "run() before prepare()");
    give(Order::run, start.SerializeAsString(), options_.communicator);
    engine_->run(start, &link);
  }

 private:
  EngineOptions options_;
  std::unique_ptr<SlugEngine> engine_;
};

template <typename Message>
Message received(MPI_Comm communicator) {
  std::string bytes;
  broadcast(bytes, communicator);
  Message message;
  const bool parsed = message.ParseFromString(bytes);
  GS_ASSERT(parsed, "rank 0 passed on a damaged message");
  return message;
}

}  // namespace

std::unique_ptr<participant::ImpactorBackend> make_impactor(const EngineOptions& options) {
  return std::make_unique<Impactor>(options);
}

void follow(const EngineOptions& options) {
  const EngineOptions all = completed(options);
  std::unique_ptr<SlugEngine> engine;
  while (true) {
    int word = 0;
    MPI_Bcast(&word, 1, MPI_INT, 0, all.communicator);
    if (static_cast<Order>(word) == Order::leave) return;
    try {
      if (static_cast<Order>(word) == Order::prepare) {
        const auto setup = received<wire::Setup>(all.communicator);
        engine.reset();
        engine = std::make_unique<SlugEngine>(all, setup);
        resident_bytes_of_all(all.communicator);
      } else {
        engine->run(received<wire::Start>(all.communicator), nullptr);
      }
    } catch (const std::runtime_error&) {
      // Rank 0 has met the same and reports it: errors are raised on all ranks alike, or travel through RankExchange.
    }
  }
}

}  // namespace grainstep::dem
