/// @file What every Channel promises, once for all implementations.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "transport/channel.hpp"

namespace grainstep::transport::testing {

struct ConnectedPair {
  std::shared_ptr<void> surroundings;  // directories and the like, destroyed last
  std::unique_ptr<Channel> left;
  std::unique_ptr<Channel> right;
};

struct Implementation {
  std::string name;
  std::function<ConnectedPair()> connect;
};

inline void PrintTo(const Implementation& one, std::ostream* out) { *out << one.name; }

/// All of them; the list that the suite runs over.
std::vector<Implementation> implementations();

}  // namespace grainstep::transport::testing
