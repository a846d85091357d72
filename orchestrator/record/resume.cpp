#include "orchestrator/record/resume.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "orchestrator/record/build_info.hpp"

namespace grainstep::orchestrator {
namespace {

using Json = nlohmann::ordered_json;

/// What the orchestrator itself goes on from.
struct Own {
  std::uint64_t window = 0;
  std::vector<double> surface;
  std::vector<std::string> datasets;
  std::vector<std::uint64_t> rows;
  std::string recorder;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("window", window);
    archive("surface", surface);
    archive("datasets", datasets);
    archive("their rows", rows);
    archive("recorder", recorder);
  }
};

/// Differences that --inexact bears: results are then as good, and not the same bits.
constexpr std::pair<const char*, bool> keys[] = {
    {"scene", false},          {"window", false},          {"windows", false},
    {"impactor_steps", false}, {"structure_steps", false}, {"ranks", true},
    {"version", true},         {"commit", true},           {"isa", true},
    {"impactor", true},        {"structure", true}};

}  // namespace

results::Parts parts_of(Resume resume) {
  Own own{.window = resume.checkpoint.window,
          .surface = std::move(resume.checkpoint.surface),
          .datasets = {},
          .rows = {},
          .recorder = std::move(resume.recorder)};
  for (const auto& [dataset, rows] : resume.contents) {
    own.datasets.push_back(dataset);
    own.rows.push_back(rows);
  }
  results::Parts parts;
  parts["about"] = std::move(resume.about);
  parts["orchestrator"] = base::saved(own);
  parts["impactor"] = std::move(resume.checkpoint.impactor);
  parts["structure"] = std::move(resume.checkpoint.structure);
  return parts;
}

std::string text_of(const About& about) {
  const BuildInfo& build = build_info();
  return Json{{"scene", about.scene_hash},
              {"window", about.plan.window},
              {"windows", about.plan.windows},
              {"impactor_steps", about.plan.impactor_steps},
              {"structure_steps", about.plan.structure_steps},
              {"ranks", about.ranks},
              {"version", build.version},
              {"commit", build.commit},
              {"isa", build.isa},
              {"impactor", about.impactor},
              {"structure", about.structure}}
      .dump(2, ' ', false, Json::error_handler_t::replace);
}

Resume load_resume(const results::RunDirectory& directory, std::optional<std::uint64_t> from) {
  const results::Checkpoints checkpoints(directory.checkpoints());
  const std::vector<std::uint64_t> there = checkpoints.windows();
  if (there.empty()) {
    throw InputError(
        directory.path().string() +
        ": has no checkpoint. They are written every ten minutes, and when a run is ended by Ctrl-C or SIGTERM, where "
        "both participants can save their state (docs/user/running.md).");
  }
  results::Parts parts = checkpoints.read(from.value_or(there.back()));
  try {
    Own own;
    base::restore(own, parts.at("orchestrator"));
    Resume out{.checkpoint = {.window = own.window,
                              .impactor = std::move(parts.at("impactor")),
                              .structure = std::move(parts.at("structure")),
                              .surface = std::move(own.surface)},
               .contents = {},
               .recorder = std::move(own.recorder),
               .about = parts.at("about")};
    for (std::size_t n = 0; n < std::min(own.datasets.size(), own.rows.size()); ++n) {
      out.contents[own.datasets[n]] = own.rows[n];
    }
    return out;
  } catch (const std::exception& error) {  // a part is missing, or is another one
    throw InputError(directory.checkpoints().string() + ": window " + std::to_string(from.value_or(there.back())) +
                     ": no checkpoint of this version: " + error.what());
  }
}

void require_same(const Resume& resume, const About& now, bool inexact) {
  const Json then = Json::parse(resume.about);
  const Json here = Json::parse(text_of(now));
  for (const auto& [key, bearable] : keys) {
    if (then.value(key, Json()) == here.value(key, Json()) || (inexact && bearable)) continue;
    throw InputError(std::string("the checkpoint is of ") + key + " " + then.value(key, Json()).dump() +
                     ", this run of " + here.value(key, Json()).dump() +
                     (bearable ? "; --inexact goes on all the same, but not bit for bit"
                               : "; a run goes on with the scene that it began with"));
  }
}

}  // namespace grainstep::orchestrator
