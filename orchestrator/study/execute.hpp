/// @file The open points of a study, computed: each a `grainstep run` of its own, several at a time.
///
/// Processes rather than sessions inside this one: a run is then exactly what a user would start, and whatever ends one
/// (an assertion, a full memory) leaves the others alone. Start from the main thread (child_process.hpp).
#pragma once

#include <string>
#include <vector>

#include "orchestrator/record/progress.hpp"
#include "orchestrator/study/outcome.hpp"
#include "orchestrator/study/plan.hpp"

namespace grainstep::study {

struct Execution {
  int jobs = 1;   ///< runs at a time
  int ranks = 1;  ///< MPI ranks of every impactor
  bool allow_program = false;
  bool allow_deck = false;
  orchestrator::Progress::Style progress = orchestrator::Progress::Style::quiet;
};

/// Computes the points whose outcome is open and fills their outcomes in; equal scenes are computed once. The most
/// expensive ones come first, so that no long one is left alone at the end. Returns false when interrupted: the runs in
/// progress were ended in good order, what was done is kept.
[[nodiscard]] bool execute(const Plan& plan, const Execution& how, std::vector<Outcome>& outcomes);

}  // namespace grainstep::study
