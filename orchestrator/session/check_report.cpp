#include "orchestrator/session/check_report.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "base/error.hpp"
#include "ledger/observables.hpp"
#include "results/vtk_xml.hpp"

namespace grainstep::orchestrator {
namespace {

constexpr std::size_t longest_name = 64;
constexpr std::size_t longest_unit = 32;

[[noreturn]] void refuse(const Peer& peer, const char* message, std::uint64_t window, const std::string& text) {
  throw PeerError(peer.name(), std::string(message) + " of window " + std::to_string(window) + ": " + text);
}

/// For messages: whatever a peer calls something, a terminal can show it.
std::string shown(const std::string& text) {
  std::string out;
  for (const char c : text.substr(0, longest_name)) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte > 0x7e ? '?' : c;
  }
  return "'" + out + (text.size() > longest_name ? "..." : "") + "'";
}

const char* name_rule = "; expected lower case letters, digits and '_', a letter first, at most 64";

bool is_unit(const std::string& unit) {
  return unit.size() <= longest_unit &&
         std::ranges::all_of(unit, [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; });
}

struct Entities {
  const char* of;  // "point" or "cell"
  std::size_t count;
};

void check_fields(const Peer& peer, const wire::Snapshot& snapshot,
                  const google::protobuf::RepeatedPtrField<wire::Field>& fields, const Entities& entities) {
  std::set<std::string> names;
  const std::string kind = std::string(entities.of) + " field ";
  for (const wire::Field& field : fields) {
    const auto wrong = [&](const std::string& text) {
      refuse(peer, "Snapshot", snapshot.window(), kind + shown(field.name()) + text);
    };
    if (!is_name(field.name())) wrong(std::string(" has no name that a dataset could have") + name_rule);
    if (!names.insert(field.name()).second) wrong(" comes twice");
    if (!is_unit(field.unit())) wrong(" has a unit that cannot be shown");
    if (field.components() < 1 || field.components() > 9) {
      wrong(" has " + std::to_string(field.components()) + " components; expected 1 to 9");
    }
    const std::size_t expected = field.components() * entities.count;
    if (static_cast<std::size_t>(field.value_size()) != expected) {
      wrong(" holds " + std::to_string(field.value_size()) + " values, expected " + std::to_string(expected) + " (" +
            std::to_string(field.components()) + " for each of " + std::to_string(entities.count) + ")");
    }
  }
}

}  // namespace

bool is_name(const std::string& name) {
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto fits = [&letter](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && name.size() <= longest_name && letter(name.front()) && std::ranges::all_of(name, fits);
}

void ReportCheck::momentum(const Peer& peer, const wire::Report& report) const {
  const wire::Momentum& m = report.momentum();
  const bool full = peer.ready.ledger() == wire::FULL;
  const struct {
    const char* name;
    int found;
    bool needed;
  } vectors[] = {{"linear", m.linear_size(), full},
                 {"interface_impulse", m.interface_impulse_size(), true},
                 {"support_impulse", m.support_impulse_size(), full}};
  for (const auto& vector : vectors) {
    if (vector.found == static_cast<int>(dimension_) || (!vector.needed && vector.found == 0)) continue;
    refuse(peer, "Report", report.window(),
           std::string("momentum.") + vector.name + " has " + std::to_string(vector.found) +
               " components, the run has " + std::to_string(dimension_) + " dimensions");
  }
}

void ReportCheck::observables(const Peer& peer, const wire::Report& report) {
  std::set<std::string> names;
  for (const wire::Observable& one : report.observable()) {
    const auto wrong = [&](const std::string& text) {
      refuse(peer, "Report", report.window(), "observable " + shown(one.name()) + text);
    };
    if (!is_name(one.name())) wrong(std::string(" has no name that a dataset could have") + name_rule);
    if (!names.insert(one.name()).second) wrong(" comes twice");
    if (!is_unit(one.unit())) wrong(" has a unit that cannot be shown");
    const auto known = ledger::unit_of(peer.role, one.name());
    if (known && one.unit() != *known) {
      wrong(" has the unit " + shown(one.unit()) + "; the catalogue (proto/README.md) says '" + std::string(*known) +
            "'");
    }
    if (first_) {
      units_[one.name()] = one.unit();
      continue;
    }
    const auto before = units_.find(one.name());
    if (before == units_.end()) wrong(" is new: the first report did not have it");
    if (before->second != one.unit()) {
      wrong(" has the unit " + shown(one.unit()) + ", in the first report it was " + shown(before->second));
    }
  }
  for (const auto& [name, unit] : units_) {
    if (names.contains(name)) continue;
    refuse(peer, "Report", report.window(), "observable " + shown(name) + " is missing: the first report had it");
  }
  first_ = false;
}

void ReportCheck::report(const Peer& peer, const wire::Report& report) {
  momentum(peer, report);
  observables(peer, report);
}

void ReportCheck::snapshot(const Peer& peer, const wire::Snapshot& snapshot) const {
  const auto wrong = [&](const std::string& text) { refuse(peer, "Snapshot", snapshot.window(), text); };
  const unsigned dimension = snapshot.dimension() == 0 ? 2 : snapshot.dimension();
  if (dimension != 2 && dimension != 3) wrong("has dimension " + std::to_string(dimension) + "; expected 2 or 3");
  if (static_cast<unsigned>(snapshot.position_size()) % dimension != 0) {
    wrong("position holds " + std::to_string(snapshot.position_size()) + " numbers, no multiple of " +
          std::to_string(dimension));
  }
  const std::size_t points = static_cast<std::size_t>(snapshot.position_size()) / dimension;
  const std::size_t corners = results::vtk::points_per_cell(snapshot);
  if (static_cast<std::size_t>(snapshot.cell_size()) % corners != 0) {
    wrong("cell holds " + std::to_string(snapshot.cell_size()) + " point numbers, no multiple of " +
          std::to_string(corners));
  }
  for (const std::uint32_t point : snapshot.cell()) {
    if (point >= points) {
      wrong("a cell names point " + std::to_string(point) + ", but there are " + std::to_string(points));
    }
  }
  check_fields(peer, snapshot, snapshot.point_field(), {"point", points});
  check_fields(peer, snapshot, snapshot.cell_field(),
               {"cell", static_cast<std::size_t>(snapshot.cell_size()) / corners});
}

}  // namespace grainstep::orchestrator
