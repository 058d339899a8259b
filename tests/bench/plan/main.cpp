// What the planner is fitted to and judged by: `./run plan-model`, `./run plan-check`. Rows of JSON, one a
// scene; those that a file has are not measured again.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <set>

#include "penumbra/mesh/error.h"
#include "tests/bench/plan/cases.h"
#include "tests/bench/plan/measure.h"
#include "tests/bench/plan/scaling.h"

namespace penumbra::bench {
namespace {

constexpr const char* kHelp = R"(penumbra_plan_bench WHAT FILE [CASE...]
  fit      scenes of the fit, at 320x240; those by chance at 240x180
  foolish  scenes on which some method is foolish, at 320x240, and what auto does for errors of .05 to .002
  facts    facts anew for the rows of FILE, which keep what was measured: written into FILE.facts
  plans    facts anew and what auto does anew, for the rows of random: written into FILE.plans
  random   random-FIRST random-LAST, at 240x180, and what auto does for one error each
  errors   random-FIRST random-LAST, at 240x180: what auto does for errors of .05 to .003, without times
  scaling  (no FILE) what casters and lights cost that the picture does not call for
Adds a line of JSON to FILE for each scene that it has not. K/N before the cases: of N shares the Kth, from 0.)";

OptionValues rays(std::uint64_t samples, std::uint64_t areas_up_to = 0) {
  return {{"samples", samples}, {"areas-up-to", areas_up_to}};
}

std::vector<Setting> fit_settings() {
  std::vector<Setting> out{{"silhouette", "silhouette", {}}};
  for (const std::uint64_t n : {16, 144}) {
    const std::string text = std::to_string(n);
    out.push_back({"rays-" + text, "rays", rays(n)});
    out.push_back({"areas-" + text, "rays", rays(n, n / 4)});
    out.push_back({"reference-" + text, "reference", {{"samples", n}}});
  }
  return out;
}

/// Those that are compared with auto.
std::vector<Setting> ladder() {
  std::vector<Setting> out{{"silhouette", "silhouette", {}}};
  for (const std::uint64_t n : {16, 64, 256}) {
    const std::string text = std::to_string(n);
    out.push_back({"rays-" + text, "rays", rays(n)});
    out.push_back({"areas-" + text, "rays", rays(n, n / 4)});
    out.push_back({"reference-" + text, "reference", {{"samples", n}}});
  }
  return out;
}

std::uint64_t seed_of(const std::string& name) {
  return std::stoull(name.substr(name.find('-') + 1));
}

constexpr double kBudgets[] = {0.05, 0.03, 0.02, 0.01, 0.005, 0.003};

/// Another one for each scene in turn.
double budget_of(std::uint64_t seed) {
  return kBudgets[seed % std::size(kBudgets)];
}

std::set<std::string> names_in(const std::string& file) {
  std::set<std::string> names;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto row = nlohmann::json::parse(line, nullptr, false);
    if (!row.is_discarded()) names.insert(row.at("name").get<std::string>());
  }
  return names;
}

constexpr MeasureOptions kSmall{.width = 240, .height = 180, .judged = 500, .judge_samples = 1'024};

bool is_random(const std::string& name) {
  return name.starts_with("random-");
}

nlohmann::json measure(const std::string& what, const std::string& name) {
  if (what == "fit" && is_random(name)) return MeasuredScene(plan_case(name), kSmall).row(ladder(), {});
  if (what == "fit") return MeasuredScene(plan_case(name), {}).row(fit_settings(), {});
  if (what == "foolish")
    return MeasuredScene(plan_case(name), {.judged = 500, .judge_samples = 1'024})
        .row(ladder(), {0.05, 0.02, 0.01, 0.005, 0.002});
  if (what == "errors") {
    nlohmann::json row =
        MeasuredScene(plan_case(name), kSmall).row({}, {std::begin(kBudgets), std::end(kBudgets)}, false);
    row.erase("facts");
    return row;
  }
  return MeasuredScene(plan_case(name), kSmall).row(ladder(), {budget_of(seed_of(name))});
}

std::vector<std::string> random_cases(const std::vector<std::string>& ends) {
  if (ends.size() != 2) throw UsageError("random needs two seeds: the first and the last");
  std::vector<std::string> out;
  for (auto seed = std::stoull(ends[0]); seed <= std::stoull(ends[1]); ++seed)
    out.push_back("random-" + std::to_string(seed));
  return out;
}

/// `with_plans`: also what auto does; else nothing is judged.
void measure_anew(const std::string& file, bool with_plans) {
  std::ifstream in(file);
  std::ofstream out(file + (with_plans ? ".plans" : ".facts"));
  for (std::string line; std::getline(in, line);) {
    nlohmann::json row = nlohmann::json::parse(line);
    const auto name = row.at("name").get<std::string>();
    MeasureOptions options = is_random(name) ? kSmall : MeasureOptions{};
    std::vector<double> budgets;
    if (with_plans && is_random(name)) budgets.push_back(budget_of(seed_of(name)));
    if (budgets.empty()) options.judged = 0;
    const MeasuredScene scene(plan_case(name), options);
    nlohmann::json anew = scene.planned(is_random(name) ? ladder() : fit_settings());
    if (!budgets.empty()) anew.update(scene.row({}, budgets));
    for (const char* key : {"facts", "plan_ms", "kept", "auto"})
      if (anew.contains(key)) row[key] = anew.at(key);
    out << row.dump() << "\n" << std::flush;
  }
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 1 && words[0] == "scaling") {
    std::printf("%s\n", measure_scaling().dump(2).c_str());
    return 0;
  }
  if (words.size() == 2 && (words[0] == "facts" || words[0] == "plans"))
    return measure_anew(words[1], words[0] == "plans"), 0;
  constexpr const char* kWhats[] = {"fit", "foolish", "random", "errors"};
  if (words.size() < 2 || std::ranges::find(kWhats, words[0], [](const char* what) {
                            return std::string(what);
                          }) == std::end(kWhats)) {
    std::puts(kHelp);
    return 2;
  }
  std::vector<std::string> names(words.begin() + 2, words.end());
  std::size_t share = 0, shares = 1;
  if (!names.empty() && names[0].find('/') != std::string::npos) {
    share = std::stoul(names[0]);
    shares = std::stoul(names[0].substr(names[0].find('/') + 1));
    names.erase(names.begin());
  }
  if (words[0] == "random" || words[0] == "errors") names = random_cases(names);
  if (names.empty()) names = words[0] == "fit" ? fit_cases() : foolish_cases();
  const std::set<std::string> known = names_in(words[1]);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (i % shares != share || known.contains(name)) continue;
    nlohmann::json row = measure(words[0], name);
    row["name"] = name;
    std::ofstream(words[1], std::ios::app) << row.dump() + "\n" << std::flush;
    std::printf("%s\n", name.c_str());
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace penumbra::bench

int main(int argc, char** argv) {
  try {
    return penumbra::bench::run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    std::fprintf(stderr, "penumbra_plan_bench: %s\n", e.what());
    return 1;
  }
}
