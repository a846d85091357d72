/// @file fuzz-... [-runs=N] CORPUS...: in place of libFuzzer, where the compiler has none. Tries every file of the
/// corpora, then N scripts made of them: the same ones every time.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "input.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t most_bytes = 1U << 14U;

std::vector<Bytes> read_all(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::filesystem::path> files;
  for (const auto& folder : folders) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<Bytes> all;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    all.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return all;
}

void try_one(const Bytes& bytes) { static_cast<void>(LLVMFuzzerTestOneInput(bytes.data(), bytes.size())); }

void try_changed(const std::vector<Bytes>& corpus, std::uint64_t runs) {
  std::mt19937_64 random(1);
  Bytes work(most_bytes);
  for (std::uint64_t run = 0; run < runs; ++run) {
    const Bytes& seed = corpus[random() % corpus.size()];
    const Bytes& other = corpus[random() % corpus.size()];
    std::size_t size = std::min(seed.size(), most_bytes);
    std::copy_n(seed.begin(), size, work.begin());
    if (random() % 8 == 0) {
      size = LLVMFuzzerCustomCrossOver(seed.data(), seed.size(), other.data(), other.size(), work.data(), most_bytes,
                                       static_cast<unsigned>(random()));
    }
    size = LLVMFuzzerCustomMutator(work.data(), size, most_bytes, static_cast<unsigned>(random()));
    // Of its own length, so that a sanitizer sees what is read beyond the end.
    try_one({work.begin(), work.begin() + static_cast<std::ptrdiff_t>(size)});
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t runs = 0;
  std::vector<std::filesystem::path> folders;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("-runs=")) {
      std::from_chars(word.data() + std::strlen("-runs="), word.data() + word.size(), runs);
    } else {
      folders.emplace_back(word);
    }
  }
  static_cast<void>(LLVMFuzzerInitialize(&argc, &argv));
  const std::vector<Bytes> corpus = read_all(folders);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no corpus; expected the folders that hold it\n", argv[0]);
    return 2;
  }
  for (const Bytes& bytes : corpus) try_one(bytes);
  try_changed(corpus, runs);
  return 0;
}
