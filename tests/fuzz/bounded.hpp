/// @file Backends that refuse what is merely large. A mesh of millions of elements, or a window of millions of steps,
/// is no fault of the message that asks for it, and takes as long as it takes: a fuzzed scene must not ask for one.
#pragma once

#include <functional>

#include "base/error.hpp"
#include "participant/backend.hpp"
#include "statistics.hpp"

namespace grainstep::fuzz {

[[noreturn]] inline void too_large() {
  ++statistics().skipped;
  throw InputError("too large to compute here");
}

/// How many elements it would take; not a number, or anything else, where the scene makes no sense.
using ElementsOf = std::function<double(const wire::Setup&)>;

inline void require_few_elements(const wire::Setup& setup, const ElementsOf& elements_of) {
  constexpr double many = 300.0;
  if (elements_of && elements_of(setup) > many) too_large();
}

/// Steps that a window of this Start has for a side that is stable up to `stable` s.
inline void require_few_steps(const wire::Start& start, std::uint32_t steps, double stable) {
  constexpr double many = 24.0;
  if (steps > many || start.window() > many * stable) too_large();
}

class BoundedStructure final : public participant::StructureBackend {
 public:
  BoundedStructure(participant::StructureBackend& inner, ElementsOf elements_of)
      : inner_(inner), elements_of_(std::move(elements_of)) {}

  [[nodiscard]] wire::Hello describe() const override { return inner_.describe(); }
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    require_few_elements(setup, elements_of_);
    wire::Ready ready = inner_.prepare(setup);
    stable_ = ready.stable_step();
    return ready;
  }
  void start(const wire::Start& start) override {
    require_few_steps(start, start.structure_steps(), stable_);
    inner_.start(start);
  }
  void advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) override {
    inner_.advance(forces, due, next);
  }
  void report(wire::Report& report) override { inner_.report(report); }
  void snapshot(wire::Snapshot& snapshot) override { inner_.snapshot(snapshot); }
  void complete() override { inner_.complete(); }
  [[nodiscard]] std::string save() override { return inner_.save(); }
  void restore(std::string_view state) override { inner_.restore(state); }

 private:
  participant::StructureBackend& inner_;
  ElementsOf elements_of_;
  double stable_ = 0.0;
};

class BoundedImpactor final : public participant::ImpactorBackend {
 public:
  BoundedImpactor(participant::ImpactorBackend& inner, ElementsOf elements_of)
      : inner_(inner), elements_of_(std::move(elements_of)) {}

  [[nodiscard]] wire::Hello describe() const override { return inner_.describe(); }
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    require_few_elements(setup, elements_of_);
    wire::Ready ready = inner_.prepare(setup);
    stable_ = ready.stable_step();
    return ready;
  }
  void run(const wire::Start& start, participant::ImpactorLink& link) override {
    require_few_steps(start, start.impactor_steps(), stable_);
    inner_.run(start, link);
  }

 private:
  participant::ImpactorBackend& inner_;
  ElementsOf elements_of_;
  double stable_ = 0.0;
};

}  // namespace grainstep::fuzz
