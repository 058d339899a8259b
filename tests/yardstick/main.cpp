// The yardstick: what every method makes of scenes at any scale, judged by rays in double and by closed
// forms. penumbra_yardstick [PATTERN...]
#include <cstdio>
#include <cstring>
#include <exception>

#include "tests/yardstick/parts.h"

int main(int argc, char** argv) {
  using namespace penumbra::yardstick;
  if (argc > 1 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0)) {
    std::puts(
        "penumbra_yardstick [PATTERN...]\nJudges methods by rays in double and by closed forms. A case is "
        "PART/CASE/METHOD; a PATTERN is\na part, or such a path with * in it: cases/ground_*/silhouette\n"
        "Parts: cases lights moves suns plates patterns merging certificates");
    return 0;
  }
  try {
    Report report({argv + 1, argv + argc});
    const struct {
      const char* name;
      void (*judge)(Report&);
    } parts[] = {{"cases", judge_cases},     {"lights", judge_lights},
                 {"moves", judge_moves},     {"suns", judge_suns},
                 {"plates", judge_plates},   {"patterns", judge_patterns},
                 {"merging", judge_merging}, {"certificates", judge_certificates}};
    for (const auto& part : parts)
      if (report.wants(part.name)) part.judge(report);
    return report.conclude();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "penumbra_yardstick: %s\n", e.what());
    return 1;
  }
}
