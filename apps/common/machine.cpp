#include "apps/common/machine.h"

#include <fstream>
#include <string>
#include <thread>

namespace penumbra::apps {
namespace {

/// "model name" of /proc/cpuinfo.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t start = line.find(": ");
    if (start != std::string::npos) return line.substr(start + 2);
  }
  return "unknown";
}

const char* instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return "AVX-512";
  if (__builtin_cpu_supports("avx2")) return "AVX2";
  return "SSE2";
#else
  return "unknown";
#endif
}

}  // namespace

nlohmann::json describe_machine() {
  return {{"processor", processor()},
          {"cores", std::thread::hardware_concurrency()},
          {"instruction_set", instruction_set()}};
}

std::size_t peak_memory_bytes() {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("VmHWM:")) return std::stoull(line.substr(6)) * 1024;  // "VmHWM:   12345 kB"
  return 0;
}

}  // namespace penumbra::apps
