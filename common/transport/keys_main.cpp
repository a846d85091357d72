/// @file grainstep-keys DIR: makes the keys that encrypt and authenticate tcp connections.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "base/error.hpp"
#include "transport/curve.hpp"

int main(int argc, char** argv) {
  using grainstep::ExitCode;
  CLI::App app{
      "Makes orchestrator.key, orchestrator.pub, participant.key and participant.pub in DIR.\n"
      "The orchestrator needs orchestrator.key and participant.pub, a participant on another host participant.key and\n"
      "orchestrator.pub.",
      "grainstep-keys"};
  std::filesystem::path directory;
  app.add_option("directory", directory, "Where the keys are made; keys that are there already stay")->required();
  app.set_version_flag("--version", GRAINSTEP_VERSION);
  try {
    app.parse(argc, argv);
    grainstep::transport::make_keys(directory);
    return static_cast<int>(ExitCode::done);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_input);
  } catch (const grainstep::InputError& error) {
    std::fprintf(stderr, "grainstep-keys: %s\n", error.what());
    return static_cast<int>(ExitCode::bad_input);
  }
}
