#include "dem-service/slug/step_driver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "participant/schedule.hpp"

namespace grainstep::dem {
namespace {

SurfaceContactSettings contact_settings(const SlugModel& model, const StepSettings& settings) {
  return {.law = calibrated_surface_law(model, settings.dt),
          .shape = model.spheres() ? contact::Shape::revolved : contact::Shape::extruded,
          .whole = model.whole(),
          .lever_is_radius = model.lever_is_radius,
          .free_mass = model.free_mass,
          .chord = model.chord,
          .largest_radius = model.largest() / 2.0,
          .particle_margin = settings.margin,
          .surface_margin = settings.margin / 2.0};
}

}  // namespace

StepDriver::StepDriver(const SlugModel& model, const wire::Start& start, const StepSettings& settings,
                       MovingSurface surface, Exchange& exchange)
    : model_(model),
      start_(start),
      settings_(settings),
      surface_(std::move(surface)),
      exchange_(exchange),
      contacts_(contact_settings(model, settings)),
      nodal_(surface_.node_count()) {
  const auto add = [&](const Plane& plane, const ContactLaw& law) {
    planes_.emplace_back(plane, law, settings.margin);
  };
  if (model.mirror) add({.kind = Plane::Kind::mirror}, calibrated_pair_law(model, settings.dt));
  if (!model.confined && !model.spheres()) return;
  const ContactLaw wall = calibrated_surface_law(model, settings.dt);
  if (model.spheres()) {
    add({.inward = {{0.0, 0.0, 1.0}}}, wall);
    add({.inward = {{std::sin(model.slice), 0.0, -std::cos(model.slice)}}}, wall);
    return;
  }
  add({.inward = {{-1.0, 0.0, 0.0}}, .position = -model.half_width}, wall);
  if (!model.mirror) add({.inward = {{1.0, 0.0, 0.0}}, .position = -model.half_width}, wall);
}

void StepDriver::check_speed(const ParticleArrays& particles) {
  for (int i = 0; i < particles.owned; ++i) {
    const double* v = particles.velocity[i];
    const double way2 = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * settings_.dt * settings_.dt;
    if (way2 <= particles.radius[i] * particles.radius[i]) continue;  // false for what is not a number
    std::ostringstream text;
    text << "particle " << particles.identity[i] << " moves more than its radius in one step (velocity " << v[0] << ", "
         << v[1] << ", " << v[2] << " m/s, step " << settings_.dt
         << " s): the computation is unstable; take shorter steps (steps.impactor)";
    exchange_.fail(text.str());
    return;
  }
}

// A surface that moves several radii in one step could leave a particle behind it that was never near it.
void StepDriver::check_surface_speed() {
  const double speed = surface_.fastest();
  if (speed * settings_.dt <= model_.smallest() / 2.0) return;
  std::ostringstream text;
  text << "a node of the surface moves at " << speed << " m/s, more than the smallest particle's radius in one step of "
       << settings_.dt << " s: the structure's computation is unstable, or steps.impactor is too large";
  exchange_.fail(text.str());
}

void StepDriver::rebuild(const ParticleArrays& particles) {
  if (ended_) return;
  check_speed(particles);
  contacts_.rebuild(particles, surface_);
  for (PlaneContacts& plane : planes_) plane.rebuild(particles);
}

void StepDriver::next_interval(std::uint64_t step, const ParticleArrays& particles) {
  const std::uint64_t steps = start_.impactor_steps();
  const std::uint64_t into_window = (step - 1) % steps + 1;
  if (into_window == 1) {
    surface_.arrive();
    ended_ = !exchange_.receive((step - 1) / steps + 1, surface_);
    if (ended_) return;
    check_surface_speed();
  }
  contacts_.begin_interval(surface_, settings_.dt);
  for (PlaneContacts& plane : planes_) plane.begin_interval(settings_.dt);
  surface_.move_to(static_cast<double>(into_window) / static_cast<double>(steps));
  if (contacts_.surface_left_margin(surface_)) contacts_.rebuild(particles, surface_);
}

// Pair forces do not need the surface. The first step of a window computes them before it waits for the structure's
// answer, which then has had the pair forces of two steps for its way; the last one hands over before it computes them.
bool StepDriver::waits_after_pair_forces(std::uint64_t step) const {
  return start_.impactor_steps() > 1 && step % start_.impactor_steps() == 1;
}

void StepDriver::before_pair_forces(std::uint64_t step, const ParticleArrays& particles) {
  if (!waits_after_pair_forces(step)) touch(step, particles);
}

void StepDriver::touch(std::uint64_t step, const ParticleArrays& particles) {
  const bool hands_over = step % start_.impactor_steps() == 0;
  if (hands_over && start_.impactor_steps() > 1) exchange_.announce();
  if (step > 0 && !ended_) next_interval(step, particles);
  if (ended_) return;
  const double weight = step == 0 ? settings_.dt / 2.0 : settings_.dt;
  const double grown = step == 0 ? 0.0 : settings_.dt;
  if (const auto failure = contacts_.evaluate(particles, surface_, grown, weight, nodal_)) exchange_.fail(*failure);
  for (PlaneContacts& plane : planes_) plane.evaluate(particles);
  if (hands_over) exchange_.hand_over(step / start_.impactor_steps(), nodal_);
}

void StepDriver::after_pair_forces(std::uint64_t step, const ParticleArrays& particles) {
  if (waits_after_pair_forces(step)) touch(step, particles);
  if (ended_) return;
  contacts_.apply(particles);
  for (const PlaneContacts& plane : planes_) plane.apply(particles);
}

double StepDriver::top_of_surface() const {
  double top = -std::numeric_limits<double>::infinity();
  for (const surface::Vec2& node : surface_.now().nodes()) top = std::max(top, node[1]);
  return top;
}

participant::Due StepDriver::due_after(std::uint64_t step) const {
  if (step % start_.impactor_steps() != 0) return {};
  return participant::due_at(start_, step / start_.impactor_steps());
}

void StepDriver::end_of_step(std::uint64_t step, const ParticleArrays& particles, const PairEnergy& pairs) {
  if (ended_) return;
  const double interval = step == 0 ? 0.0 : settings_.dt;  // no interval ends at the start
  contacts_.end_interval(particles, surface_, interval);
  for (PlaneContacts& plane : planes_) plane.end_interval(particles, interval);
  largest_pair_overlap_ = std::max(largest_pair_overlap_, pairs.largest_overlap);
  const participant::Due due = due_after(step);
  const std::uint64_t window = step / start_.impactor_steps();
  if (due.report) report(window, step, particles, pairs);
  if (due.snapshot) {
    wire::Snapshot snapshot;
    snapshot.set_window(window);
    gather_snapshot(model_, particles, exchange_, snapshot);
    if (exchange_.is_root()) exchange_.send(static_cast<const wire::Snapshot&>(snapshot));
  }
}

void StepDriver::report(std::uint64_t window, std::uint64_t step, const ParticleArrays& particles,
                        const PairEnergy& pairs) {
  ReportSums sums;
  ReportMaxima maxima;
  add_particles(model_, particles, sums, maxima);
  const InterfaceLedger& surface = contacts_.ledger();
  sums.pair_normal = pairs.stored_normal;
  sums.pair_tangential = pairs.stored_tangential;
  sums.pair_damping = pairs.damping;
  sums.pair_work_tangential = pairs.tangential;
  sums.surface_normal = contacts_.stored_normal();
  sums.surface_tangential = contacts_.stored_tangential();
  sums.surface_damping = surface.damping;
  sums.surface_work_tangential = surface.tangential;
  sums.work_on_particles = surface.work_on_particles;
  sums.work_on_surface = surface.work_on_surface;
  sums.surface_contacts = static_cast<double>(contacts_.count());
  std::copy_n(surface.impulse.c.begin(), 3, sums.surface_impulse);
  sums.radial = surface.radial;
  sums.size = surface.size;
  sums.around = surface.around;
  sums.around_work = surface.around_work;
  maxima.overlap = std::max(std::exchange(largest_pair_overlap_, 0.0), contacts_.take_largest_overlap());
  for (PlaneContacts& plane : planes_) {
    sums.plane_stored += plane.stored();
    sums.plane_damping += plane.ledger().damping;
    for (std::size_t c = 0; c < 3; ++c) sums.plane_impulse[c] += plane.ledger().impulse[c];
    maxima.overlap = std::max(maxima.overlap, plane.take_largest_overlap());
  }
  const ReportSums all = summed(sums, exchange_);
  const ReportMaxima most = largest(maxima, exchange_);
  if (!exchange_.is_root()) return;

  wire::Report message;
  message.set_window(window);
  fill_report(model_, all, most, message);
  message.mutable_timing()->set_steps(step);
  const bool lost = model_.fixed_number && all.particles != static_cast<double>(model_.particles);
  if (!std::isfinite(all.kinetic) || lost) {
    std::ostringstream text;
    text << "after " << step << " steps " << all.particles << " of " << model_.particles
         << " particles are left, with a kinetic energy of " << all.kinetic
         << " J: the computation is unstable; take shorter steps (steps.impactor)";
    exchange_.fail(text.str());
  }
  if (const auto wrong = dissipation_.look(message.energy())) exchange_.fail(*wrong);
  exchange_.send(message);
}

}  // namespace grainstep::dem
