#include "dem-service/deck/deck_engine.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "dem-service/deck/deck_particles.hpp"
#include "dem-service/lammps/adapter.hpp"
#include "dem-service/lammps/attach.hpp"
#include "dem-service/lammps/pair_style.hpp"
#include "surface/disc_overlap.hpp"

namespace grainstep::dem {
namespace {

namespace fs = std::filesystem;

/// For as long as it lives, the process works in another folder: scripts name files relative to their own.
class WorkingFolder {
 public:
  explicit WorkingFolder(const fs::path& folder) : before_(fs::current_path()) {
    if (!folder.empty()) fs::current_path(folder);
  }
  ~WorkingFolder() {
    std::error_code ignored;
    fs::current_path(before_, ignored);
  }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  fs::path before_;
};

std::string value_text(const std::string& name, const google::protobuf::Value& value) {
  if (value.has_number_value()) return number_text(value.number_value());
  if (value.has_string_value()) return value.string_value();
  throw InputError("impactor.deck.variables." + name + ": expected a number or a text");
}

}  // namespace

DeckEngine::DeckEngine(const EngineOptions& options, const wire::Setup& setup)
    : options_(options), setup_(setup), session_(options.communicator, options.lammps_log) {
  if (!options_.allow_deck) {
    throw InputError(
        "impactor.deck: a script can do anything on this machine, so it is run on your word only: start "
        "this participant with --allow-deck");
  }
  require_deck_scene(setup);
  run_script();
  const scene::DeckContact& contact = setup.impactor().impactor().deck().contact();
  particles_ = deck_particles(session_.lammps(), options.communicator);
  model_ = make_deck_model(contact, particles_);
  const wire::Surface& surface = setup.impactor().surface();
  if (!surface.facet().empty()) {
    meet(model_, {}, setup.impactor().free_mass(), mean_length(MovingSurface(surface).now()));
  }
}

void DeckEngine::run_script() {
  const scene::Deck& deck = setup_.impactor().impactor().deck();
  const TemporaryDirectory scratch;
  fs::path script = fs::absolute(deck.file());
  if (deck.file().empty()) {
    script = scratch.path() / "script";
    std::ofstream(script) << deck.text() << '\n';
  }
  PairStyle::register_style(session_.lammps());
  for (const auto& [name, value] : deck.variables().fields()) {
    session_.command("variable " + name + " index " + value_text(name, value));
  }
  const WorkingFolder beside(deck.file().empty() ? fs::path() : script.parent_path());
  try {
    if (!session_.run_script(script.string())) {
      throw InputError("impactor.deck: the script has no run command; up to the first one it is run, and then driven");
    }
  } catch (const NumericalError& error) {  // in a script that somebody has written, it is an input
    throw InputError(std::string("impactor.deck: ") + error.what());
  }
}

wire::Ready DeckEngine::ready() const { return ready_of(model_, particles_); }

void DeckEngine::run(const wire::Start& start, participant::ImpactorLink* link) {
  require_beginning(start);
  const double dt = start.window() / start.impactor_steps();
  session_.command(fmt::format("timestep {:.17g}", dt));
  drive({.session = session_,
         .communicator = options_.communicator,
         .model = model_,
         .surface = setup_.impactor().surface(),
         .settings = {dt, lammps::facts_of(session_.lammps()).skin / 2.0},
         .own_pair_style = particles_.own_pair_style},
        start, link);
}

}  // namespace grainstep::dem
