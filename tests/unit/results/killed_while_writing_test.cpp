/// The writer of results is killed before its n-th call that changes a file, for every n: what is visible is one of its
/// bursts, whole.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "results/results_file.hpp"
#include "scratch.hpp"

namespace {

// Calls that are still let through; below zero: all of them.
long calls_left = -1;

void count_one() {
  if (calls_left < 0) return;
  if (calls_left-- == 0) raise(SIGKILL);
}

}  // namespace

// What the libraries write files with comes by here: a program's own functions are taken before those of the C library.
extern "C" {
ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t offset) {
  count_one();
  return syscall(SYS_pwrite64, fd, bytes, count, offset);
}
ssize_t pwrite(int fd, const void* bytes, size_t count, off_t offset) { return pwrite64(fd, bytes, count, offset); }
int ftruncate64(int fd, off64_t length) noexcept {
  count_one();
  return static_cast<int>(syscall(SYS_ftruncate, fd, length));
}
int ftruncate(int fd, off_t length) noexcept { return ftruncate64(fd, length); }
int unlink(const char* path) noexcept {
  count_one();
  return static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, 0));
}
int link(const char* from, const char* to) noexcept {
  count_one();
  return static_cast<int>(syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int rename(const char* from, const char* to) noexcept {
  count_one();
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
}

namespace grainstep::results {
namespace {

constexpr int bursts = 4;
constexpr int rows_per_burst = 100;

void write_bursts(ResultsFile& file) {
  for (int burst = 0; burst < bursts; ++burst) {
    for (int row = 0; row < rows_per_burst; ++row) {
      const double value = burst * rows_per_burst + row;
      file.add({{.dataset = "/series/time", .meaning = {"s", "time"}, .value = value},
                {.dataset = "/ledger/energy", .meaning = {"J", "energy"}, .value = -value}});
      file.add(Line{.dataset = "/profiles/pressure", .meaning = {"Pa", "pressure"}, .values = {value, 2.0 * value}});
    }
    file.add(Array{.dataset = "/snapshots/" + std::to_string(burst),
                   .meaning = {"", ""},
                   .values = std::vector<double>(500, burst),
                   .indices = {}});
    file.flush();
  }
}

/// True when the writer came to its end before it was to be killed.
bool write_in_another_process(const std::filesystem::path& path, long calls) {
  const pid_t child = fork();
  if (child == 0) {
    ResultsFile file(path, {});
    calls_left = calls;
    write_bursts(file);
    _exit(0);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) || WTERMSIG(status) == SIGKILL);
  return WIFEXITED(status);
}

/// How many bursts the file holds; each is there as a whole, in every dataset.
int whole_bursts(const std::filesystem::path& path) {
  const h5::File file = h5::File::read(path);
  if (!file.has("/series/time")) return 0;
  const std::vector<double> time = file.read_doubles("/series/time");
  EXPECT_EQ(time.size() % rows_per_burst, 0U);
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_EQ(time[i], static_cast<double>(i));
  EXPECT_EQ(file.read_doubles("/ledger/energy").size(), time.size());
  EXPECT_EQ(file.read_doubles("/profiles/pressure").size(), 2 * time.size());
  const int whole = static_cast<int>(time.size()) / rows_per_burst;
  for (int burst = 0; burst < whole; ++burst) {
    EXPECT_THAT(file.read_doubles("/snapshots/" + std::to_string(burst)), ::testing::Each(burst));
  }
  return whole;
}

TEST(KilledWhileWriting, WholeBurstsAreVisibleWhateverTheInstant) {
  const Scratch scratch;
  std::array<int, bursts + 1> seen{};
  int last = 0;
  long calls = 0;
  for (;; ++calls) {
    const std::filesystem::path path = scratch.path() / (std::to_string(calls) + ".h5");
    const bool finished = write_in_another_process(path, calls);
    const int whole = whole_bursts(path);
    ASSERT_FALSE(HasFailure()) << "killed before call " << calls;
    EXPECT_GE(whole, last) << "killed later, and holds less";
    last = whole;
    ++seen.at(static_cast<std::size_t>(whole));
    if (finished) break;
    for (const char* ending : {"", ".next", ".last"}) std::filesystem::remove(path.string() + ending);
  }
  EXPECT_GT(calls, 10L * bursts) << "the library writes in another way: count its calls";
  EXPECT_EQ(last, bursts);
  for (int burst = 0; burst < bursts; ++burst) EXPECT_GT(seen.at(static_cast<std::size_t>(burst)), 5) << burst;
}

}  // namespace
}  // namespace grainstep::results
