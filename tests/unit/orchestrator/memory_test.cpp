// What does not fit is refused before anything is started.
#include "orchestrator/command/memory.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::uint64_t gibibyte = 1ULL << 30U;

struct Impactor {
  const char* counted = "particles";
  std::uint64_t size = 0, memory = 0, rank_memory = 0;
};

Preparation of(const Impactor& impactor, std::uint64_t structure) {
  Preparation out;
  if (std::string(impactor.counted) == "elements") out.scene.mutable_impactor()->set_type(scene::Impactor::TYPE_FOAM);
  out.impactor.emplace();
  out.impactor->set_counted(impactor.counted);
  out.impactor->set_size(impactor.size);
  out.impactor->set_memory(impactor.memory);
  out.impactor->set_rank_memory(impactor.rank_memory);
  out.structure.emplace();
  out.structure->set_counted("elements");
  out.structure->set_memory(structure);
  return out;
}

std::string refusal(const Preparation& preparation, std::uint64_t machine) {
  try {
    require_memory(preparation, 1, machine);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Memory, BothSidesAndAllRanksCount) {
  const Preparation p = of({.memory = 5 * gibibyte, .rank_memory = gibibyte}, 2 * gibibyte);
  EXPECT_EQ(memory_of(p, 1), 7 * gibibyte);
  EXPECT_EQ(memory_of(p, 4), 10 * gibibyte);
  EXPECT_EQ(memory_of({}, 1), 0U);  // both external
  Preparation foam = of({.counted = "elements", .size = 10'000'000, .memory = gibibyte}, 0);
  EXPECT_EQ(memory_of(foam, 1), gibibyte);
  foam.scene.mutable_output()->set_snapshots(5);
  EXPECT_GT(memory_of(foam, 1), 3 * gibibyte);
}

TEST(Memory, WhatDoesNotFitIsRefusedByTheLargerSide) {
  const Preparation sand = of({.size = 10, .memory = 5 * gibibyte}, 2 * gibibyte);
  EXPECT_EQ(refusal(sand, 7 * gibibyte), "");
  EXPECT_THAT(refusal(sand, 6 * gibibyte),
              AllOf(HasSubstr("particle.diameter"), HasSubstr("7 GiB"), HasSubstr("6 GiB"), HasSubstr("raise")));
  const Preparation foam = of({.counted = "elements", .size = 10, .memory = 5 * gibibyte}, 2 * gibibyte);
  EXPECT_THAT(refusal(foam, gibibyte), AllOf(HasSubstr("impactor.foam.elements"), HasSubstr("lower")));
  EXPECT_THAT(refusal(of({}, 2 * gibibyte), gibibyte), HasSubstr("structure.mesh.refinement"));
  EXPECT_NO_THROW(require_memory(sand, 1, std::nullopt));
  EXPECT_NO_THROW(require_memory(sand, 2, gibibyte));
}

TEST(Memory, TheMachineHasSome) { EXPECT_GT(memory_of_machine().value_or(0), gibibyte / 4); }

// Both ways in which Linux shows a container's limit; one without a limit says "max", or more than all memory.
TEST(Memory, AContainerHasWhatItsGroupAllows) {
  const TemporaryDirectory scratch;
  const std::filesystem::path& groups = scratch.path();
  const std::uint64_t all = memory_of_machine(groups).value();
  constexpr std::uint64_t limit = 64ULL << 20U;
  ASSERT_GT(all, limit);
  const auto say = [&](const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories((groups / file).parent_path());
    std::ofstream(groups / file) << text << '\n';
  };
  const std::filesystem::path first = "memory/memory.limit_in_bytes";
  say(first, "9223372036854771712");
  EXPECT_EQ(memory_of_machine(groups), all);
  say(first, std::to_string(limit));
  EXPECT_EQ(memory_of_machine(groups), limit);
  std::filesystem::remove(groups / first);
  say("memory.max", "max");
  EXPECT_EQ(memory_of_machine(groups), all);
  say("memory.max", std::to_string(limit));
  EXPECT_EQ(memory_of_machine(groups), limit);
}

}  // namespace
}  // namespace grainstep::orchestrator
