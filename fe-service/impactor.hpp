/// @file grainstep-fe in the impactor's role: becomes what the scene asks for, a foam projectile or a prescribed load.
#pragma once

#include <memory>

#include "participant/backend.hpp"

namespace grainstep::fe {

class Impactor final : public participant::ImpactorBackend {
 public:
  [[nodiscard]] wire::Hello describe() const override;
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override;
  void run(const wire::Start& start, participant::ImpactorLink& link) override;

 private:
  std::unique_ptr<participant::ImpactorBackend> impactor_;
};

}  // namespace grainstep::fe
