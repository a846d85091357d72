#include "base/error.hpp"
#include "participant/data_path.hpp"
#include "transport/shared_channel.hpp"

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

class SharedDataPath final : public DataPath {
 public:
  SharedDataPath(const std::filesystem::path& file, wire::Role role, WhileWaiting look)
      : path_(open(file)),
        channel_(path_, role == wire::IMPACTOR ? SharedPath::Way::forces : SharedPath::Way::kinematics,
                 other_side(role), std::move(look)),
        messages_(channel_, other_side(role)) {}

  wire::MessageChannel& messages() override { return messages_; }
  void knock() override { channel_.knock(); }
  bool wants_copies() const override { return false; }  // it listens to the memory itself

 private:
  SharedPath path_;
  transport::SharedChannel channel_;
  wire::MessageChannel messages_;
};

}  // namespace

std::unique_ptr<DataPath> share_memory(const std::filesystem::path& file, wire::Role role, WhileWaiting look) {
  return std::make_unique<SharedDataPath>(file, role, std::move(look));
}

}  // namespace grainstep::participant
