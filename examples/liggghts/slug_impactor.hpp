/// @file The slug of a scene, computed by LIGGGHTS: what is said and heard. No LIGGGHTS here: another particle code
/// would have the same file.
#pragma once

#include <dem-service/slug/model.hpp>
#include <memory>
#include <participant/backend.hpp>
#include <string>

class Engine;

class SlugImpactor final : public grainstep::participant::ImpactorBackend {
 public:
  /// `log`: a file for LIGGGHTS's own log; empty: none.
  explicit SlugImpactor(std::string log);
  ~SlugImpactor() override;
  SlugImpactor(const SlugImpactor&) = delete;
  SlugImpactor& operator=(const SlugImpactor&) = delete;

  [[nodiscard]] grainstep::wire::Hello describe() const override;
  [[nodiscard]] grainstep::wire::Ready prepare(const grainstep::wire::Setup& setup) override;
  void run(const grainstep::wire::Start& start, grainstep::participant::ImpactorLink& link) override;

 private:
  std::string log_;
  grainstep::wire::Surface surface_;
  grainstep::dem::SlugModel model_;
  std::unique_ptr<Engine> engine_;
};
