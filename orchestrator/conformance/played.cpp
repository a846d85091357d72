#include "orchestrator/conformance/played.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "orchestrator/conformance/trial.hpp"
#include "participant/schedule.hpp"
#include "scene/groups.hpp"
#include "scene/needs.hpp"

namespace grainstep::conformance {
namespace {

constexpr double usual_step = 1e-6;  // s, of a participant that any step will do

double step_of(const wire::Ready& ready) { return ready.preferred_step() < 1.0 ? ready.preferred_step() : usual_step; }

void add(google::protobuf::RepeatedField<double>* out, const Vector& value, unsigned dimension) {
  for (unsigned c = 0; c < dimension; ++c) out->Add(value[c]);
}

}  // namespace

wire::Surface flat_surface(const Bench& bench) {
  wire::Surface out;
  if (bench.role == wire::STRUCTURE) return out;
  const scene::Scene& scene = bench.scene;
  const double right = scene.structure().has_half_span() ? scene.structure().half_span() : 0.1;
  const bool half = scene::has_mirror(scene) || scene.symmetry() == scene::SYMMETRY_AXISYMMETRIC;
  const double left = half ? 0.0 : -right;
  const unsigned dimension = scene::surface_dimension(scene);
  out.set_dimension(dimension);
  const auto node = [&out, dimension](const Vector& at) {
    add(out.mutable_position(), at, dimension);
    add(out.mutable_velocity(), {}, dimension);
  };
  if (dimension == 3) {
    for (const auto& [x, z] : {std::pair{left, left}, {right, left}, {right, right}, {left, right}}) node({x, 0.0, z});
    for (const unsigned corner : {0U, 2U, 1U, 0U, 3U, 2U}) out.add_facet(corner);
    return out;
  }
  constexpr unsigned segments = 16;
  for (unsigned k = 0; k <= segments; ++k) {
    node({left + (right - left) * k / segments, 0.0, 0.0});
    if (k == 0) continue;
    out.add_facet(k - 1);
    out.add_facet(k);
  }
  return out;
}

Played::Played(Subject& subject, const Bench& bench, Plan plan)
    : subject_(subject), bench_(bench), plan_(std::move(plan)), check_(subject.dimension()) {}

void Played::begin() {
  subject_.introduce();
  subject_.prepare(flat_surface(bench_));
  const wire::Ready& ready = subject_.peer().ready;
  surface_ = bench_.role == wire::STRUCTURE ? ready.surface() : flat_surface(bench_);
  start_.set_window(plan_.steps * step_of(ready));
  start_.set_windows(plan_.windows);
  start_.set_impactor_steps(bench_.role == wire::IMPACTOR ? plan_.steps : 1);
  start_.set_structure_steps(bench_.role == wire::STRUCTURE ? plan_.steps : 1);
  start_.set_report_every(plan_.report_every);
  start_.set_snapshot_every(plan_.snapshot_every);
  kinematics.push_back(moved(0));
  subject_.tell(start_);
}

wire::Forces Played::pushing(std::uint64_t window) const {
  const unsigned n = subject_.dimension();
  const auto nodes = static_cast<double>(surface_.position_size()) / n;
  Vector each = plan_.force(window);
  for (double& value : each) value *= (window == 0 ? 0.5 : 1.0) * start_.window() / nodes;
  wire::Forces out;
  out.set_window(window);
  for (int k = 0; k < surface_.position_size(); k += static_cast<int>(n)) add(out.mutable_impulse(), each, n);
  return out;
}

wire::Kinematics Played::moved(std::uint64_t window) const {
  const unsigned n = subject_.dimension();
  const double time = static_cast<double>(window) * start_.window();
  wire::Kinematics out;
  out.set_window(window);
  for (int i = 0; i < surface_.position_size(); ++i) {
    const double speed = plan_.surface_velocity[static_cast<unsigned>(i) % n];
    out.add_position(surface_.position(i) + time * speed);
    out.add_velocity(speed);
  }
  return out;
}

void Played::require_length(const char* what, int found) const {
  if (found == surface_.position_size()) return;
  throw Breach(std::string(what) + " of window " + std::to_string(window_) + " holds " + std::to_string(found) +
               " numbers, the surface has " + std::to_string(surface_.position_size()));
}

void Played::hear_extra() {
  const participant::Due due = participant::due_at(start_, window_);
  try {
    if (due.report) {
      reports.push_back(subject_.hear<wire::Report>(window_));
      check_.report(subject_.peer(), reports.back());
    }
    if (due.snapshot) {
      snapshots.push_back(subject_.hear<wire::Snapshot>(window_));
      check_.snapshot(subject_.peer(), snapshots.back());
    }
  } catch (const PeerError& error) {
    throw Breach(error.text());
  }
}

void Played::step() {
  const bool last = window_ == plan_.windows;
  try {
    if (bench_.role == wire::STRUCTURE) {
      forces.push_back(pushing(window_));
      subject_.tell(forces.back());
      if (!last) {
        kinematics.push_back(subject_.hear<wire::Kinematics>(window_ + 1));
        require_length("Kinematics.position", kinematics.back().position_size());
        require_length("Kinematics.velocity", kinematics.back().velocity_size());
      }
      hear_extra();
    } else {
      forces.push_back(subject_.hear<wire::Forces>(window_));
      require_length("Forces.impulse", forces.back().impulse_size());
      hear_extra();
      if (!last) {
        kinematics.push_back(moved(window_ + 1));
        subject_.tell(kinematics.back());
      }
    }
  } catch (const PeerError& error) {
    throw Breach(error.text());
  }
  ++window_;
}

void Played::run() {
  begin();
  while (!over()) step();
  subject_.stop();
}

void Played::tell_wrong_window() {
  if (bench_.role == wire::STRUCTURE) {
    subject_.tell(pushing(window_ + 5));
  } else {
    subject_.tell(moved(window_ + 5));
  }
}

void Played::tell_wrong_length() {
  if (bench_.role == wire::STRUCTURE) {
    wire::Forces message = pushing(window_);
    message.add_impulse(0.0);
    subject_.tell(message);
  } else {
    wire::Kinematics message = moved(window_ + 1);  // step() has told it where the surface is at the end of this one
    message.add_position(0.0);
    subject_.tell(message);
  }
}

Vector Played::given_in(std::uint64_t n) const {
  const auto dimension = static_cast<int>(subject_.dimension());
  Vector sum{};
  const wire::Forces& one = forces.at(n);
  for (int i = 0; i < one.impulse_size(); ++i) sum[static_cast<std::size_t>(i % dimension)] += one.impulse(i);
  return sum;
}

Vector Played::given_before(std::uint64_t n) const {
  Vector sum{};
  for (std::uint64_t k = 0; k < n; ++k) {
    const Vector one = given_in(k);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += one[c];
  }
  return sum;
}

}  // namespace grainstep::conformance
