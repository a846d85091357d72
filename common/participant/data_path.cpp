#include "participant/data_path.hpp"

#include "base/error.hpp"

namespace grainstep::participant {
namespace {

using transport::SharedPath;

SharedPath open(const std::filesystem::path& file) {
  try {
    return SharedPath::open(file);
  } catch (const std::exception& error) {
    throw InputError(std::string("the path of data in shared memory: ") + error.what() +
                     ". Both sides must run on the orchestrator's host, as its user; --path hub takes another way");
  }
}

const char* other(wire::Role role) { return role == wire::IMPACTOR ? "structure" : "impactor"; }

}  // namespace

DataPath::DataPath(const std::filesystem::path& file, wire::Role role, transport::SharedChannel::WhileWaiting look)
    : path_(open(file)),
      channel_(path_, role == wire::IMPACTOR ? SharedPath::Way::forces : SharedPath::Way::kinematics, other(role),
               std::move(look)),
      messages_(channel_, other(role)) {}

}  // namespace grainstep::participant
