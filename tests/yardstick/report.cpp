#include "tests/yardstick/report.h"

#include <fnmatch.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <map>

namespace penumbra::yardstick {
namespace {

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::vector<std::string> words_of(const std::string& path) {
  std::vector<std::string> words(1);
  for (const char c : path)
    if (c == '/')
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

bool matches_as_far(const std::string& pattern, const std::string& path) {
  const std::vector<std::string> patterns = words_of(pattern), words = words_of(path);
  for (std::size_t i = 0; i < std::min(patterns.size(), words.size()); ++i)
    if (!matches(patterns[i], words[i])) return false;
  return true;
}

// PART/CASE/METHOD → PART, METHOD.
std::string group_of(const std::string& name) {
  const std::vector<std::string> words = words_of(name);
  return words.size() > 2 ? words.front() + ", " + words.back() : words.front();
}

}  // namespace

bool Report::wants(const std::string& name) const {
  return patterns_.empty() ||
         std::ranges::any_of(patterns_, [&](const std::string& p) { return matches_as_far(p, name); });
}

void Report::add(const std::string& name, bool right, const std::string& figures) {
  std::printf("%-7s%-46s %s\n", right ? "right" : "WRONG", name.c_str(), figures.c_str());
  std::fflush(stdout);
  findings_.push_back({name, right});
}

int Report::conclude() const {
  std::map<std::string, std::pair<int, int>> groups;  // right, all
  for (const Finding& finding : findings_) {
    auto& [right, all] = groups[group_of(finding.name)];
    right += finding.right;
    ++all;
  }
  std::printf("\n");
  for (const auto& [group, count] : groups)
    std::printf("%-40s %d of %d right\n", group.c_str(), count.first, count.second);
  int failures = 0;
  for (const std::string& pattern : required_) {
    bool found = false;
    for (const Finding& finding : findings_) {
      if (!matches(pattern, finding.name)) continue;
      found = true;
      if (finding.right) continue;
      std::printf("required, and wrong: %s\n", finding.name.c_str());
      ++failures;
    }
    if (found || !patterns_.empty()) continue;
    std::printf("required, and no such case: %s\n", pattern.c_str());
    ++failures;
  }
  return failures > 0 ? 1 : 0;
}

std::string text(const char* format, ...) {
  char out[256];
  va_list values;
  va_start(values, format);
  std::vsnprintf(out, sizeof out, format, values);
  va_end(values);
  return out;
}

}  // namespace penumbra::yardstick
