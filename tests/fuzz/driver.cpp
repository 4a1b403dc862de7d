// nook_fuzz TARGET|all SECONDS [SEED [CORPUS]]: mutated inputs to a reader, without a fuzzing engine; inputs
// of CORPUS/TARGET/* are seeds too. An input that brings the reader down is left in nook_fuzz.TARGET.input.
// nook_fuzz --seeds FOLDER: writes the seeds to FOLDER/TARGET/* and the words to FOLDER/TARGET.dict, as
// libFuzzer and AFL++ read them.
#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

#include "mutate.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace nook::fuzz;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What the reader is given, for the handler of a crash.
std::string kept, under_test;

void keep_input() {
  nook::test::write_bytes(kept, under_test);
}

void on_crash(int number) {
  std::signal(number, SIG_DFL);
  keep_input();
  std::raise(number);
}

bool fuzz(Target target, double limit, unsigned seed, const std::filesystem::path& corpus) {
  std::error_code none;
  if (!corpus.empty())
    for (const auto& entry : std::filesystem::directory_iterator(corpus / target.name, none))
      target.seeds.push_back(nook::test::read_bytes(entry.path()));
  std::mt19937 random(seed);
  kept = std::string("nook_fuzz.") + target.name + ".input";
  std::vector<std::string> pool = target.seeds;
  unsigned long long runs = 0;
  double slowest = 0;
  for (const double end = seconds() + limit; seconds() < end; ++runs) {
    const bool as_is = runs < pool.size();
    const std::string& input = under_test =
        as_is ? pool[runs] : mutate(pool[random() % pool.size()], target, random);
    const double start = seconds();
    try {
      run_once(target, input);
    } catch (const std::exception& e) {
      keep_input();
      std::printf("%s: FAILED after %llu inputs: %s (see %s)\n", target.name, runs, e.what(), kept.c_str());
      return false;
    }
    slowest = std::max(slowest, seconds() - start);
    if (slowest > 20) {
      keep_input();
      std::printf("%s: FAILED after %llu inputs: %.1f s (see %s)\n", target.name, runs, slowest,
                  kept.c_str());
      return false;
    }
    // A mutant now and then becomes a parent, so that changes add up.
    if (!as_is && random() % 64 == 0)
      pool[target.seeds.size() > 64 || pool.size() > 256 ? random() % pool.size()
                                                         : (pool.push_back(""), pool.size() - 1)] = input;
  }
  std::printf("%s: %llu inputs, slowest %.3f s\n", target.name, runs, slowest);
  return true;
}

// "ply\n" -> "ply\x0a", as dictionaries want it.
std::string quoted(const std::string& word) {
  std::string out;
  for (const unsigned char c : word) {
    char code[8];
    std::snprintf(code, sizeof code, "\\x%02x", unsigned(c));
    out += std::isalnum(c) || c == ' ' ? std::string(1, char(c)) : code;
  }
  return '"' + out + "\"\n";
}

void write_seeds(const std::filesystem::path& folder) {
  for (const Target& target : targets()) {
    std::filesystem::create_directories(folder / target.name);
    for (std::size_t i = 0; i < target.seeds.size(); ++i)
      nook::test::write_bytes(folder / target.name / ("seed" + std::to_string(i)), target.seeds[i]);
    std::string dictionary;
    for (const std::string& word : target.tokens) dictionary += quoted(word);
    nook::test::write_bytes(folder / (std::string(target.name) + ".dict"), dictionary);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "usage: nook_fuzz TARGET|all SECONDS [SEED [CORPUS]] | --seeds FOLDER\n");
    return 2;
  }
  const std::string wanted = arguments[1];
  if (wanted == "--seeds") {
    write_seeds(arguments[2]);
    return 0;
  }
  const double limit = std::atof(arguments[2]);
  const unsigned seed = count > 3 ? unsigned(std::atoi(arguments[3])) : 1;
  const std::filesystem::path corpus = count > 4 ? arguments[4] : "";
  for (const int number : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(number, on_crash);
  bool good = true, found = false;
  for (const Target& target : targets()) {
    if (wanted != "all" && wanted != target.name) continue;
    found = true;
    good = fuzz(target, wanted == "all" ? limit / double(targets().size()) : limit, seed, corpus) && good;
  }
  if (!found) std::fprintf(stderr, "no target %s\n", wanted.c_str());
  return good && found ? 0 : 1;
}
