#include "base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace grainstep {

void assertion_failed(const char* condition, const char* file, int line, const std::string& values) {
  std::fprintf(stderr, "%s:%d: internal error: (%s) does not hold: %s\n", file, line, condition, values.c_str());
  std::abort();
}

}  // namespace grainstep
