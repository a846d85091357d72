#include "orchestrator/record/summary.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "scene/load.hpp"

namespace grainstep::orchestrator {
namespace {

using Json = nlohmann::ordered_json;

// Groups that a scene has not, or that are infinite (a slug at rest), have no JSON number.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string text_of(const Json& value, const char* format) {
  if (!value.is_number()) {
    return "-";
  }
  char out[64];
  std::snprintf(out, sizeof out, format, value.get<double>());
  return out;
}

/// m; not a number for a structure that does not say it.
double half_span_of(const scene::Structure& structure) {
  return structure.has_half_span() ? structure.half_span() : std::numeric_limits<double>::quiet_NaN();
}

/// Which books a side kept; what it did not keep was not judged.
Json ledger_word(const wire::Ready& ready) {
  if (ready.ledger() == wire::FULL) return "full";
  return ready.ledger() == wire::INTERFACE ? Json("interface") : Json(nullptr);
}

Json early_pressure(const SummaryInput& in) {
  const scene::Groups& g = in.groups;
  if (!in.findings.early_impulse || !(g.slug_pressure > 0.0)) {
    return nullptr;
  }
  constexpr double interval = 0.25;  // of t_hat, from 0.05 to 0.3
  return *in.findings.early_impulse / (g.slug_pressure * interval * g.slug_time);
}

/// Of a load that this structure could not change: how far it is from having been there when it was recorded.
Json recorded_load(const SummaryInput& in) {
  const auto absent = std::numeric_limits<double>::quiet_NaN();
  const bool is_one = in.scene.impactor().type() == scene::Impactor::TYPE_REPLAY;
  return {{"file", is_one ? Json(in.scene.impactor().replay().file()) : Json(nullptr)},
          {"surface_speed_ratio", number(in.findings.surface_speed_ratio.value_or(absent))},
          {"surface_speed_departure", number(in.findings.surface_speed_departure.value_or(absent))}};
}

Json split_of(const SummaryInput& in) {
  return {{"impactor_compute", in.impactor_timing.compute()},
          {"impactor_wait", in.impactor_timing.wait()},
          {"structure_compute", in.structure_timing.compute()},
          {"structure_wait", in.structure_timing.wait()},
          {"orchestrator", in.orchestrator_seconds}};
}

}  // namespace

std::string hash_text(std::uint64_t hash) {
  char out[17];
  std::snprintf(out, sizeof out, "%016llx", static_cast<unsigned long long>(hash));
  return out;
}

Json summary(const SummaryInput& in) {
  const scene::Groups& g = in.groups;
  const Findings& f = in.findings;
  Json out;
  out["status"] = in.status;
  out["reason"] = in.reason;
  out["exit_code"] = in.exit_code;
  out["impulse_number"] = number(g.impulse_number);
  out["areal_mass_ratio"] = number(g.areal_mass_ratio);
  out["loading_time_ratio"] = number(g.loading_time_ratio);
  const double half_span = half_span_of(in.scene.structure());
  out["peak_deflection"] = in.plan ? number(f.peak_deflection / half_span) : Json(nullptr);
  out["peak_deflection_time"] = in.plan ? number(f.peak_deflection_time / g.reference_time) : Json(nullptr);
  out["peak_deflection_seconds"] = in.plan ? number(f.peak_deflection_time) : Json(nullptr);
  out["final_deflection"] = f.rest ? number(f.rest->mean / half_span) : Json(nullptr);
  out["final_deflection_spread"] = f.rest ? number(f.rest->spread / half_span) : Json(nullptr);
  out["final_time"] = number(f.final_time / g.reference_time);
  out["final_seconds"] = number(f.final_time);
  out["transmitted_impulse"] = in.plan ? number(f.transmitted / g.areal_momentum) : Json(nullptr);
  out["early_pressure"] = early_pressure(in);
  const auto absent = std::numeric_limits<double>::quiet_NaN();  // a monolithic beam has no core
  out["peak_core_compression"] = number(f.peak_core_compression.value_or(absent));
  out["peak_core_compression_time"] = number(f.peak_core_compression_time.value_or(absent) / g.reference_time);
  out["energy_drift"] = in.plan ? number(f.energy_drift) : Json(nullptr);
  out["momentum_error"] = in.plan ? number(f.momentum_error) : Json(nullptr);
  out["ledgers"] = {{"impactor", ledger_word(in.impactor)}, {"structure", ledger_word(in.structure)}};
  out["recorded_load"] = recorded_load(in);
  const bool mesh = in.impactor.counted() == "elements";
  out["particles"] = mesh ? 0 : in.impactor.size();
  out["impactor_elements"] = mesh ? in.impactor.size() : 0;
  out["elements"] = in.structure.size();
  out["impactor_steps"] = std::max(f.impactor_steps, in.impactor_timing.steps());
  out["structure_steps"] = std::max(f.structure_steps, in.structure_timing.steps());
  out["impactor_step"] = in.plan ? number(in.plan->impactor_step) : Json(nullptr);
  out["structure_step"] = in.plan ? number(in.plan->structure_step) : Json(nullptr);
  out["path"] = in.path;
  out["threads"] = {{"impactor", in.threads.impactor}, {"structure", in.threads.structure}};
  out["wall_seconds"] = in.wall_seconds;
  out["wall_split"] = split_of(in);
  out["processor_seconds"] = in.impactor_timing.processor() + in.structure_timing.processor() + in.orchestrator_seconds;
  out["scene_key"] = hash_text(scene::essence_hash(in.scene));
  out["results_version"] = results_version;
  return out;
}

namespace {

// Over the half span: what a stiff structure deflects by does not fill four decimals.
std::string deflection_text(const Json& value) {
  const bool small = value.is_number() && value != 0.0 && std::abs(value.get<double>()) < 1e-3;
  return text_of(value, small ? "%.3g" : "%.4f");
}

// In t_bar, or in ms where the structure has none.
std::string moment(const Json& s, const char* key) {
  const Json& t_bar = s.at(std::string(key) + "_time");
  if (t_bar.is_number()) return "t_bar " + text_of(t_bar, "%.3f");
  const Json seconds = s.value(std::string(key) + "_seconds", Json());
  return seconds.is_number() ? text_of(1e3 * seconds.get<double>(), "%.4g") + " ms" : "-";
}

}  // namespace

std::string digest(const Json& s) {
  std::string out = "status               " + s.at("status").get<std::string>();
  if (const auto reason = s.at("reason").get<std::string>(); !reason.empty()) {
    out += ": " + reason;
  }
  out += "\nimpulse number I_o   " + text_of(s.at("impulse_number"), "%.3g");
  out += "\npeak deflection      " + deflection_text(s.at("peak_deflection")) + " w/L at " +
         moment(s, "peak_deflection") + " (run to " + moment(s, "final") + ")";
  if (s.value("final_deflection", Json()).is_number()) {
    out += "\nfinal deflection     " + deflection_text(s.at("final_deflection")) + " w/L, swings by +-" +
           deflection_text(s.at("final_deflection_spread"));
  }
  if (s.at("peak_core_compression").is_number()) {
    out += "\ncore compression     " + text_of(s.at("peak_core_compression"), "%.3f") + " of its thickness";
    if (s.at("peak_core_compression_time").is_number())
      out += " at t_bar " + text_of(s.at("peak_core_compression_time"), "%.3f");
  }
  out += "\ntransmitted impulse  " + text_of(s.at("transmitted_impulse"), "%.4f") + " I_t/I0, early pressure " +
         text_of(s.at("early_pressure"), "%.3f") + " p/(rho_bar rho_s v0^2)";
  out += "\nledgers              momentum error " + text_of(s.at("momentum_error"), "%.1e") + ", energy drift " +
         text_of(s.at("energy_drift"), "%.2e");
  for (const char* side : {"impactor", "structure"}) {
    if (s.value("ledgers", Json::object()).value(side, Json()) != "interface") continue;
    out += "\n                     the " + std::string(side) +
           " keeps no books of its own: only what passed the surface was judged";
  }
  if (const Json load = s.value("recorded_load", Json()); load.is_object() && load.at("file").is_string()) {
    out += "\nrecorded load        the surface gives way with " + text_of(load.at("surface_speed_ratio"), "%.2g") +
           " of the impactor's speed, " + text_of(load.at("surface_speed_departure"), "%+.2g") +
           " of it beyond the record";
  }
  const Json& split = s.at("wall_split");
  const bool meshed = s.value("impactor_elements", 0.0) > 0.0;
  out += "\nsize                 " +
         (meshed ? text_of(s.at("impactor_elements"), "%.0f") + " elements of the impactor, "
                 : text_of(s.at("particles"), "%.0f") + " particles, ") +
         text_of(s.at("elements"), "%.0f") + " elements, " + text_of(s.at("impactor_steps"), "%.0f") + " and " +
         text_of(s.at("structure_steps"), "%.0f") + " steps";
  out += "\nwall clock           " + text_of(s.at("wall_seconds"), "%.1f") + " s: impactor " +
         text_of(split.at("impactor_compute"), "%.1f") + " + " + text_of(split.at("impactor_wait"), "%.1f") +
         " waiting, structure " + text_of(split.at("structure_compute"), "%.1f") + " + " +
         text_of(split.at("structure_wait"), "%.1f") + " waiting, orchestrator " +
         text_of(split.at("orchestrator"), "%.1f");
  return out + "\n";
}

}  // namespace grainstep::orchestrator
