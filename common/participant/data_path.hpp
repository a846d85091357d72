/// @file A participant's end of the short path of data, if Start names one (proto/README.md, "The path of data").
#pragma once

#include <filesystem>

#include "grainstep/wire.pb.h"
#include "transport/shared_channel.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::participant {

class DataPath {
 public:
  static constexpr const char* capability = "shared_memory";  ///< the word in Hello

  /// InputError where the file cannot be opened: the sides are not on one host after all.
  DataPath(const std::filesystem::path& file, wire::Role role, transport::SharedChannel::WhileWaiting look);

  [[nodiscard]] wire::MessageChannel& messages() { return messages_; }

  void knock() { channel_.knock(); }

 private:
  transport::SharedPath path_;
  transport::SharedChannel channel_;
  wire::MessageChannel messages_;
};

}  // namespace grainstep::participant
