#include "orchestrator/record/row.hpp"

#include <array>
#include <cmath>
#include <string>

#include "ledger/observables.hpp"

namespace grainstep::orchestrator {
namespace {

using Row = std::vector<results::Entry>;

void put(Row& row, const std::string& dataset, const char* unit, const char* title, double value) {
  row.push_back({.dataset = dataset, .meaning = {unit, title}, .value = value});
}

/// As many components as the run has dimensions.
struct VectorEntry {
  const char* title;
  const ledger::Vector& value;
  unsigned dimension;
};

void put_vector(Row& row, const std::string& dataset, const char* unit, const VectorEntry& entry) {
  constexpr const char* endings[] = {"_x1", "_x2", "_x3"};
  for (unsigned c = 0; c < entry.dimension; ++c) put(row, dataset + endings[c], unit, entry.title, entry.value[c]);
}

void put_observables(Row& row, const char* side, const wire::Report& report) {
  for (const wire::Observable& o : report.observable()) {
    put(row, std::string("/series/") + side + "/" + o.name(), o.unit().c_str(), o.name().c_str(), o.value());
  }
}

void put_energy(Row& row, const std::string& side, const wire::Energy& e, double error) {
  const std::string group = "/ledger/" + side + "/energy/";
  put(row, group + "kinetic", "J", "kinetic energy, translation and rotation", e.kinetic());
  put(row, group + "elastic", "J", "stored elastic energy", e.elastic());
  put(row, group + "plastic", "J", "plastic work since the start", e.plastic());
  put(row, group + "damping", "J", "dissipated by contact dashpots since the start", e.damping());
  put(row, group + "friction", "J", "dissipated by sliding since the start", e.friction());
  put(row, group + "viscous", "J", "other dissipation since the start", e.viscous());
  put(row, group + "support_work", "J", "work of the supports on this side since the start", e.support_work());
  put(row, group + "interface_work", "J", "work on this side through the surface since the start", e.interface_work());
  put(row, group + "error", "", "what of this side's energy is not explained, over the reference", error);
}

void put_momentum(Row& row, const std::string& side, const ledger::Closure& closure, unsigned dimension) {
  const std::string group = "/ledger/" + side + "/momentum/";
  put_vector(row, group + "change", "N s", {"momentum gained since the start", closure.change, dimension});
  put_vector(row, group + "interface", "N s",
             {"impulse received through the surface since the start", closure.interface, dimension});
  put_vector(row, group + "support", "N s",
             {"impulse received from supports since the start", closure.support, dimension});
  put(row, group + "error", "", "what of this side's momentum is not explained, over the reference", closure.error);
}

}  // namespace

Row series_row(const RowData& data, const scene::Groups& groups) {
  Row row;
  put(row, "/series/time", "s", "time since first contact", data.time);
  if (std::isfinite(groups.reference_time)) {
    put(row, "/series/t_bar", "", "t / (L sqrt(rho_m/sigma_Y))", data.time / groups.reference_time);
  }
  if (std::isfinite(groups.slug_time))
    put(row, "/series/t_hat", "", "slug time t v0 / H", data.time / groups.slug_time);
  put(row, "/series/mean_pressure", "Pa", "pressure averaged over the loaded width and the row's interval (4.4)",
      data.mean_pressure);
  put(row, "/series/transmitted_impulse", "Pa s", "integral of the mean pressure (4.5)", data.transmitted);
  if (groups.areal_momentum > 0.0) {
    put(row, "/series/transmitted_impulse_ratio", "", "I_t / I0", data.transmitted / groups.areal_momentum);
  }
  put_observables(row, "impactor", data.impactor);
  put_observables(row, "structure", data.structure);
  return row;
}

Row ledger_row(const RowData& data) {
  const ledger::Balance& b = data.balance;
  Row row;
  put(row, "/ledger/time", "s", "time since first contact", data.time);
  put(row, "/ledger/momentum_error", "", "momentum that is not explained, over the reference", b.momentum_error);
  put(row, "/ledger/momentum_reference", "N s",
      "momentum of the start or, if larger, the largest impulse handed over so far", b.momentum_reference);
  put(row, "/ledger/interface_momentum", "",
      "momentum that the sides claim to have received beyond what the messages carried, over the reference",
      b.interface_momentum);
  put_vector(row, "/ledger/in_flight", "N s",
             {"impulse given by the impactor that the structure has not taken up yet", b.in_flight, data.dimension});
  put(row, "/ledger/energy", "J", "kinetic, stored and dissipated energy of both sides less the supports' work",
      b.energy);
  put(row, "/ledger/energy_reference", "J", "energy of the start or, if larger, the most supplied from outside so far",
      b.energy_reference);
  put(row, "/ledger/energy_drift", "",
      "largest of the energies that are not explained: of the whole, of each side, at the interface", b.energy_drift);
  put(row, "/ledger/energy_change", "", "change of that energy over the reference", b.energy_change);
  put(row, "/ledger/interface_mismatch", "J",
      "work on the surface as the impactor sees it, less as the structure sees it", b.interface_mismatch);
  put_energy(row, "impactor", data.impactor.energy(), b.impactor_energy);
  put_energy(row, "structure", data.structure.energy(), b.structure_energy);
  put_momentum(row, "impactor", b.impactor, data.dimension);
  put_momentum(row, "structure", b.structure, data.dimension);
  return row;
}

Row timing_row(const RowData& data) {
  Row row;
  put(row, "/timings/time", "s", "time since first contact", data.time);
  for (const auto& [side, timing] :
       {std::pair{"impactor", &data.impactor.timing()}, std::pair{"structure", &data.structure.timing()}}) {
    const std::string group = std::string("/timings/") + side + "/";
    put(row, group + "compute", "s", "wall clock time computing", timing->compute());
    put(row, group + "wait", "s", "wall clock time waiting for the other side", timing->wait());
    put(row, group + "steps", "", "steps taken", static_cast<double>(timing->steps()));
  }
  return row;
}

}  // namespace grainstep::orchestrator
