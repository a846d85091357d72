/// @file Ctrl-C or SIGTERM, as an exception that ends a run in good order.
#pragma once

#include <stdexcept>

namespace grainstep::orchestrator {

class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("ended from outside: Ctrl-C, SIGTERM or a closed terminal") {}
};

}  // namespace grainstep::orchestrator
