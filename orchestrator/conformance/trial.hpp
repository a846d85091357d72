/// @file What conformance tries: each trial plays the orchestrator, and the other side, against one participant, and
/// holds it to one clause of proto/README.md.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "orchestrator/conformance/bench.hpp"

namespace grainstep::conformance {

/// The participant does not do what the clause says; the text says what it did.
class Breach : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The participant does not say that it can do what the clause is about.
class NotOffered : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Trial {
  const char* name;       ///< short, for tables and --only
  const char* clause;     ///< what is asked, in one sentence
  const char* paragraph;  ///< of proto/README.md
  std::function<void(const Bench&)> run;
};

/// In the order in which a participant meets them. Those of both roles, then those of one.
[[nodiscard]] std::vector<Trial> trials_of(wire::Role role);

[[nodiscard]] std::vector<Trial> conversation_trials();
[[nodiscard]] std::vector<Trial> structure_trials();
[[nodiscard]] std::vector<Trial> impactor_trials();

}  // namespace grainstep::conformance
