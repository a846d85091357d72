#include "statistics.hpp"

#include <cstdio>
#include <cstdlib>

namespace grainstep::fuzz {
namespace {

Statistics all;

void print() {
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf(
      "inputs %llu, messages %llu; good ends %llu, errors that say what is wrong %llu, too large to compute %llu\n",
      number(all.inputs), number(all.messages), number(all.complete), number(all.blamed), number(all.skipped));
}

}  // namespace

Statistics& statistics() {
  static const int once = std::atexit(print);
  static_cast<void>(once);
  return all;
}

}  // namespace grainstep::fuzz
