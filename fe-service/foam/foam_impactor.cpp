#include "fe-service/foam/foam_impactor.hpp"

#include <algorithm>
#include <cmath>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "fe-service/deformable.hpp"
#include "fe-service/preview.hpp"
#include "participant/hello.hpp"
#include "participant/resumed.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fe {

wire::Hello FoamImpactor::describe() const {
  wire::Hello hello = participant::hello(
      wire::IMPACTOR, std::string("grainstep-fe (foam projectile, ") + available_kernels().front()->name + ")",
      GRAINSTEP_VERSION, {2});
  for (const char* capability : {"foam", "plane_strain", "axisymmetric", "state"}) hello.add_capabilities(capability);
  return hello;
}

wire::Ready FoamImpactor::prepare(const wire::Setup& setup) {
  if (!setup.has_impactor()) throw InputError("setup: started as an impactor, but was sent a structure's part");
  const scene::Impactor& impactor = setup.impactor().impactor();
  const FoamSetting setting{setup.symmetry(), setup.depth(), setup.mirror()};
  wire::Ready ready = preview_foam(impactor, setting).ready();
  ready.set_scene_hash(setup.scene_hash());
  if (setup.preview()) return ready;
  guards_ = setup.impactor().guards();
  model_ = make_foam_model(impactor, setting);
  surface_.emplace(setup.impactor().surface());
  body_.emplace(make_block(*model_, surface_->now()));
  contact_.emplace(*model_, *body_);
  nodal_.assign(surface_->node_count(), {});
  stable_step_ = undeformed_step_ = body_->stable_step();
  ready.set_stable_step(stable_step_in_touch(*model_, *body_, stable_step_));
  ready.set_preferred_step(preferred_foam_step(*model_, ready.stable_step()));
  ready.set_contact_time(kFoamStepsPerContact * ready.preferred_step());
  ready.set_longest_window(kFoamStepsPerWindow * ready.preferred_step());
  ready.set_mass(body_->mass());
  ready.set_contact_mass(heaviest_of_face(*body_));
  return ready;
}

/// False: the run was over before it began.
bool FoamImpactor::begin(const wire::Start& start, participant::ImpactorLink& link) {
  if (!(start.window() > 0.0) || start.impactor_steps() == 0)
    throw InputError("Start: window and impactor_steps must be above 0");
  window_length_ = start.window();
  steps_in_window_ = step_in_window_ = steps_needed_ = start.impactor_steps();
  const auto resumed = participant::resumed(start, link);
  if (!resumed) return true;
  base::restore(*this, resumed->state);
  return receive(link);
}

void FoamImpactor::run(const wire::Start& start, participant::ImpactorLink& link) {
  if (!begin(start, link)) return;
  for (;;) {
    touch(link);
    internal_forces();
    move(link);
    if (at_end_of_window() && window_ == start.windows()) return;
    if (at_end_of_window() && link.wants_state(window_)) link.send_state(base::saved(*this));
    if (!receive(link)) return;
  }
}

/// Contact where the block and the surface stand; at a window's end its impulse leaves at once.
void FoamImpactor::touch(participant::ImpactorLink& link) {
  const double weight = 0.5 * (step_before_ + next_step());
  contact_->evaluate(*body_, *surface_, step_before_, next_step(), weight, nodal_);
  if (!at_end_of_window()) return;
  wire::Forces forces;
  forces.set_window(window_);
  bool finite = true;
  for (surface::Vec2& impulse : nodal_) {
    finite = finite && std::isfinite(impulse[0] + impulse[1]);
    forces.add_impulse(impulse[0]);
    forces.add_impulse(impulse[1]);
    impulse = {};
  }
  if (!finite) check_finite(*body_, progress());
  link.send(forces);
}

void FoamImpactor::internal_forces() {
  if (step_before_ == 0.0) return;  // no stress at the start
  const SweepResult result = body_->sweep(step_before_);
  ++steps_;
  plastic_work_ += result.plastic_work;
  stored_ += result.stored;
  min_quality_ = result.min_quality;
  if (result.unconverged > 0) material_failed(*body_, progress());
  if (!(min_quality_ >= guards_.element_quality())) check_quality(*body_, guards_.element_quality(), progress());
  if (at_end_of_window() && window_ % kCheckInterval == 0) check_block();
}

void FoamImpactor::check_block() {
  check_finite(*body_, progress());
  stable_step_ = body_->stable_step();
  if (!(stable_step_ >= guards_.element_quality() * undeformed_step_))
    check_slivers(*body_, undeformed_step_, guards_.element_quality(), progress());
  const double limit = kStepLimit * stable_step_in_touch(*model_, *body_, stable_step_);
  steps_needed_ = std::max(steps_needed_, steps_needed(window_length_, limit, progress()));
  last_good_time_ = progress().time;
}

/// Velocities over t(k), what is to be said of it, and positions on to the next step's end.
void FoamImpactor::move(participant::ImpactorLink& link) {
  const participant::Due due = at_end_of_window() ? link.due(window_) : participant::Due{};
  const bool wanted = due.report || due.snapshot;
  const Velocities before = wanted ? Velocities::of(*body_) : Velocities{};
  const double next = next_step();
  const double weight = 0.5 * (step_before_ + next);
  const double part = step_before_ / (step_before_ + next);
  body_->kick(weight);
  contact_->push(*body_, weight);
  Vec2 held = hold_block(*model_, *body_);
  if (is_of_revolution(body_->measure())) held.x += weight * body_->radial_force();
  contact_->end_interval(*body_, *surface_, step_before_, part);
  if (wanted) {
    const Velocities at = Velocities::blend(before, Velocities::of(*body_), part);
    if (due.report) report(before, at, supports_ + part * held, link);
    if (due.snapshot) {
      wire::Snapshot snapshot;
      snapshot.set_window(window_);
      fill_snapshot(*body_, at, snapshot);
      link.send(snapshot);
    }
  }
  supports_ = supports_ + held;
  body_->drift(next);
  step_before_ = next;
}

/// The surface at the end of the step that the block has just made. False: the run is over.
bool FoamImpactor::receive(participant::ImpactorLink& link) {
  if (at_end_of_window()) {
    const wire::Kinematics* message = link.surface(++window_);
    if (message == nullptr) return false;
    const auto expected = static_cast<int>(2 * surface_->node_count());
    if (message->position_size() != expected || message->velocity_size() != expected)
      throw PeerError("structure", "sent the kinematics of another surface than its own at the start");
    surface_->arrive();
    surface_->aim(message->position().data(), message->velocity().data());
    steps_in_window_ = steps_needed_;
    step_in_window_ = 0;
  }
  ++step_in_window_;
  contact_->begin_interval(*surface_, step_before_);
  surface_->move_to(static_cast<double>(step_in_window_) / steps_in_window_);
  return true;
}

void FoamImpactor::report(const Velocities& before, const Velocities& at, Vec2 supports,
                          participant::ImpactorLink& link) {
  const contact::SurfaceContacts& contacts = contact_->contacts();
  const contact::InterfaceLedger& ledger = contacts.ledger();
  wire::Report report;
  report.set_window(window_);
  wire::Energy& energy = *report.mutable_energy();
  energy.set_kinetic(conserved_kinetic_energy(*body_, before, at));
  energy.set_elastic(stored_ + contacts.stored_normal() + contacts.stored_tangential());
  energy.set_plastic(plastic_work_);
  energy.set_damping(ledger.damping);
  energy.set_friction(ledger.tangential - contacts.stored_tangential());
  energy.set_interface_work(-ledger.work_on_surface);
  wire::Momentum& momentum = *report.mutable_momentum();
  const Vec2 linear = linear_momentum(*body_, at);
  for (const double p : {linear.x, linear.y}) momentum.add_linear(p);
  for (const std::size_t c : {std::size_t{0}, std::size_t{1}}) momentum.add_interface_impulse(ledger.impulse[c]);
  for (const double p : {supports.x, supports.y}) momentum.add_support_impulse(p);
  add_observable(report, "max_overlap", "", contact_->take_largest_overlap());
  add_observable(report, "slug_top", "m", *std::max_element(body_->corners.y.begin(), body_->corners.y.end()));
  add_observable(report, "slug_spread", "m", *std::max_element(body_->corners.x.begin(), body_->corners.x.end()));
  add_observable(report, "contacts_with_surface", "", static_cast<double>(contacts.count()));
  add_observable(report, "work_on_surface", "J", ledger.work_on_surface);
  add_observable(report, "work_on_particles", "J", ledger.work_on_particles);
  add_observable(report, "foam_element_quality", "", min_quality_);
  add_observable(report, "foam_stable_step", "s", stable_step_);
  report.mutable_timing()->set_steps(steps_);
  link.send(report);
}

Progress FoamImpactor::progress() const {
  Progress progress;
  progress.step = steps_;
  progress.time =
      window_length_ * (static_cast<double>(window_) - 1.0 + static_cast<double>(step_in_window_) / steps_in_window_);
  progress.last_good_time = last_good_time_;
  progress.body = "foam";
  progress.mesh_key = "impactor.foam.elements";
  progress.step_key = "steps.impactor";
  return progress;
}

}  // namespace grainstep::fe
