/// @file A study as it will be run, known before anything is started: every point loaded, checked and named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "declare/tree.hpp"
#include "grainstep/study.pb.h"
#include "orchestrator/command/preparation.hpp"

namespace grainstep::study {

struct PlannedPoint {
  std::string series;  ///< as written
  std::string name;    ///< as written, or made from the values on the axes; the series' if it is its only point
  std::string id;      ///< "series/name", or the series' name: how a study refers to it
  std::filesystem::path directory;  ///< of its run, relative to that of the study
  std::vector<std::string> set;     ///< all overrides, in order
  bool is_long = false;
  orchestrator::Preparation preparation;
  std::string key;        ///< the same for the same scene, see essence_hash()
  double estimate = 0.0;  ///< s, of the slower side on a core of its own; of points that were not asked the last one's
};

struct Plan {
  std::filesystem::path file;
  Study study;
  declare::Tree tree;  ///< where everything was written
  std::vector<PlannedPoint> points;
};

enum class Fidelity {
  recommended,  ///< the study as it stands
  full          ///< with its `full` overrides
};

/// Points whose participants are asked beforehand what they cost and whether they can compute them; those beyond are
/// asked when they run, and are taken to cost what the last one did.
inline constexpr std::size_t most_asked = 16;

/// Reads the study and prepares all of its points. @throws InputError with everything that is wrong, one line each.
/// `options`: of every run.
[[nodiscard]] Plan load_plan(const std::filesystem::path& file, Fidelity fidelity = Fidelity::recommended,
                             const orchestrator::RunOptions& options = {});

/// The point called `id`; nullptr: there is none.
[[nodiscard]] const PlannedPoint* point_of(const Plan& plan, const std::string& id);

/// A directory's name that reads like `name`: letters, digits, '.', '_', '+', '=' and '-'.
[[nodiscard]] std::string slug(const std::string& name);

}  // namespace grainstep::study
