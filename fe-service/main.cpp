/// @file grainstep-fe: the structure of a run, or an impactor without particles, as a program.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>

#include "base/error.hpp"
#include "fe-service/impactor.hpp"
#include "fe-service/structure.hpp"
#include "participant/connect.hpp"
#include "participant/serve.hpp"

namespace {

int run(const grainstep::participant::ConnectOptions& options, const std::string& role) {
  try {
    const auto channel = grainstep::participant::open(options);
    if (role == "impactor") {
      grainstep::fe::Impactor impactor;
      return grainstep::participant::serve_impactor(*channel, impactor);
    }
    grainstep::fe::Structure structure;
    return grainstep::participant::serve_structure(*channel, structure);
  } catch (const grainstep::InputError& error) {
    std::cerr << "grainstep-fe: " << error.what() << '\n';
    return static_cast<int>(grainstep::ExitCode::bad_input);
  } catch (const grainstep::PeerError& error) {
    std::cerr << "grainstep-fe: " << error.what() << '\n';
    return static_cast<int>(grainstep::ExitCode::peer);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Grainstep's structure: finite elements in step with what hits them", "grainstep-fe"};
  grainstep::participant::ConnectOptions options;
  grainstep::participant::add_connect_options(app, options);
  std::string role = "structure";
  app.add_option("--role", role,
                 "structure (default), or impactor: a foam projectile, a prescribed pressure, or no load")
      ->check(CLI::IsMember({"structure", "impactor"}));
  app.set_version_flag("--version", GRAINSTEP_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(grainstep::ExitCode::bad_input);
  }
  return run(options, role);
}
