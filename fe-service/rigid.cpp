#include "fe-service/rigid.hpp"

#include "base/error.hpp"

namespace grainstep::fe {

Rigid::Rigid(const scene::Structure& structure) {
  if (structure.layers().empty())
    throw InputError("structure.layers: none given; a rigid target takes its depth from them");
  double thickness = 0.0;
  for (const scene::Layer& layer : structure.layers()) thickness += layer.thickness();
  const double half = structure.half_span();
  if (structure.extent() == scene::Structure::EXTENT_FULL) {
    outline_ = {{-half, -thickness}, {-half, 0.0}, {half, 0.0}, {half, -thickness}};
  } else {
    outline_ = {{0.0, 0.0}, {half, 0.0}, {half, -thickness}};
  }
}

void Rigid::fill_ready(wire::Ready& ready) const {
  ready.set_stable_step(kNoStepLimit);
  ready.set_preferred_step(kNoStepLimit);
  wire::Surface& surface = *ready.mutable_surface();
  for (std::uint32_t k = 0; k < outline_.size(); ++k) {
    surface.add_position(outline_[k].x);
    surface.add_position(outline_[k].y);
    surface.add_velocity(0.0);
    surface.add_velocity(0.0);
    if (k == 0) continue;
    surface.add_segment(k - 1);
    surface.add_segment(k);
  }
}

void Rigid::start(const wire::Start& start) { check_start(start); }

void Rigid::advance(const wire::Forces& forces, participant::Due /*due*/, wire::Kinematics& next) {
  check_forces(forces, outline_.size());
  Vec2 impulse{0.0, 0.0};
  for (int i = 0; i + 1 < forces.impulse_size(); i += 2)
    impulse = impulse + Vec2{forces.impulse(i), forces.impulse(i + 1)};
  counted_ = received_ + (window_ == 0 ? 0.0 : 0.5) * impulse;
  received_ = received_ + impulse;
  ++window_;
  next.Clear();
  next.set_window(window_);
  for (const Vec2 node : outline_) {
    next.add_position(node.x);
    next.add_position(node.y);
    next.add_velocity(0.0);
    next.add_velocity(0.0);
  }
}

void Rigid::report(wire::Report& report) {
  report.Clear();
  report.set_window(window_ - 1);
  report.mutable_energy();
  wire::Momentum& momentum = *report.mutable_momentum();
  for (const double p : {0.0, 0.0}) momentum.add_linear(p);
  for (const double p : {counted_.x, counted_.y}) momentum.add_interface_impulse(p);
  for (const double p : {counted_.x, counted_.y}) momentum.add_support_impulse(-p);
  add_observable(report, "deflection", "m", 0.0);
  add_observable(report, "peak_deflection", "m", 0.0);
  add_observable(report, "peak_deflection_time", "s", 0.0);
  report.mutable_timing()->set_steps(window_);
}

void Rigid::snapshot(wire::Snapshot& snapshot) {
  snapshot.Clear();
  snapshot.set_window(window_ - 1);
  for (const Vec2 node : outline_) {
    snapshot.add_position(node.x);
    snapshot.add_position(node.y);
  }
}

}  // namespace grainstep::fe
