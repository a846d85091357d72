/// @file The backend of grainstep-fe: describes itself, then becomes what the scene asks for.
#pragma once

#include <memory>
#include <optional>

#include "fe-service/windows.hpp"
#include "participant/backend.hpp"

namespace grainstep::fe {

class Structure final : public participant::StructureBackend {
 public:
  explicit Structure(int threads = 1) : threads_(threads) {}

  [[nodiscard]] wire::Hello describe() const override;
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override;
  void start(const wire::Start& start) override;
  void advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) override;
  void report(wire::Report& report) override;
  void snapshot(wire::Snapshot& snapshot) override;
  void complete() override;
  [[nodiscard]] std::string save() override { return prepared().save(); }
  void restore(std::string_view state) override { prepared().restore(state); }

 private:
  [[nodiscard]] WindowedStructure& prepared();
  int threads_;
  std::optional<base::Team> team_;
  std::unique_ptr<WindowedStructure> structure_;
};

}  // namespace grainstep::fe
