#include "dem-service/lammps/impactor.hpp"

#include <utility>

#include "base/assert.hpp"
#include "base/error.hpp"
#include "declare/ranges.hpp"
#include "dem-service/deck/deck_engine.hpp"
#include "dem-service/lammps/slug_engine.hpp"
#include "dem-service/mpi_start.hpp"
#include "dem-service/slug/preview.hpp"
#include "participant/hello.hpp"

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

std::unique_ptr<Engine> make_engine(const EngineOptions& options, const wire::Setup& setup) {
  if (setup.impactor().impactor().type() == scene::Impactor::TYPE_DECK) {
    return std::make_unique<DeckEngine>(options, setup);
  }
  return std::make_unique<SlugEngine>(options, setup);
}

class Impactor final : public participant::ImpactorBackend {
 public:
  explicit Impactor(EngineOptions options) : options_(std::move(options)) {}
  ~Impactor() override {
    if (options_.communicator != MPI_COMM_NULL) give(Order::leave, {}, options_.communicator);
    engine_.reset();
  }
  Impactor(const Impactor&) = delete;
  Impactor& operator=(const Impactor&) = delete;
  Impactor(Impactor&&) = delete;
  Impactor& operator=(Impactor&&) = delete;

  [[nodiscard]] wire::Hello describe() const override {
    wire::Hello hello = participant::hello(wire::IMPACTOR, "grainstep-dem (LAMMPS)", GRAINSTEP_VERSION, {2});
    for (const char* word : {"slug", "deck", "plane_strain", "axisymmetric", "size_distribution", "tension_cutoff"})
      hello.add_capabilities(word);
    if (can_save()) hello.add_capabilities("state");
    return hello;
  }

  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    if (!setup.has_impactor()) throw InputError("setup: grainstep-dem is an impactor, but was sent a structure's part");
    const scene::Impactor& impactor = setup.impactor().impactor();
    const bool deck = impactor.type() == scene::Impactor::TYPE_DECK;
    if (impactor.type() != scene::Impactor::TYPE_SLUG && !deck) {
      throw InputError("impactor.type: grainstep-dem computes `slug` and `deck`, this scene has another one");
    }
    declare::require_ranges(impactor, "impactor");
    wire::Ready ready;
    if (setup.preview() && !deck) {  // what a script makes is known when it has been run
      ready = preview(impactor, setup.symmetry(), setup.depth(), setup.mirror()).ready(setup.impactor().surface());
    } else {
      build(setup);
      ready = engine_->ready();
    }
    ready.set_scene_hash(setup.scene_hash());
    return ready;
  }

  void run(const wire::Start& start, participant::ImpactorLink& link) override {
    GS_ASSERT(engine_ != nullptr, "run() before prepare()");
    give(Order::run, start.SerializeAsString(), options_.communicator);
    engine_->run(start, &link);
  }

 private:
  /// A slug in one process; who may be sent a script may have anything to save.
  [[nodiscard]] bool can_save() const {
    if (options_.allow_deck) return false;
    int ranks = 1;
    if (options_.communicator != MPI_COMM_NULL) MPI_Comm_size(options_.communicator, &ranks);
    return ranks == 1;
  }

  // A preview of a slug needs no MPI, which takes longer to start than all the rest.
  void build(const wire::Setup& setup) {
    options_ = completed(options_);
    give(Order::prepare, setup.SerializeAsString(), options_.communicator);
    engine_.reset();
    engine_ = make_engine(options_, setup);
  }

  EngineOptions options_;
  std::unique_ptr<Engine> engine_;
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
  std::unique_ptr<Engine> engine;
  while (true) {
    int word = 0;
    MPI_Bcast(&word, 1, MPI_INT, 0, all.communicator);
    if (static_cast<Order>(word) == Order::leave) return;
    try {
      if (static_cast<Order>(word) == Order::prepare) {
        const auto setup = received<wire::Setup>(all.communicator);
        engine.reset();
        engine = make_engine(all, setup);
      } else {
        engine->run(received<wire::Start>(all.communicator), nullptr);
      }
    } catch (const std::runtime_error&) {
      // Rank 0 has met the same and reports it: errors are raised on all ranks alike, or travel through RankExchange.
    }
  }
}

}  // namespace grainstep::dem
