#include "apps/cli/study/study_unit.h"

#include <algorithm>

namespace penumbra::apps {
namespace {

using nlohmann::json;

std::string packed(const json& value) {
  const std::vector<std::uint8_t> bytes = json::to_cbor(value);
  return {bytes.begin(), bytes.end()};
}

json unpacked(const std::string& bytes) {
  return json::from_cbor(bytes);
}

bool asked_for(const StudyOptions& options, const std::string& name) {
  return options.methods.empty() || std::ranges::find(options.methods, name) != options.methods.end();
}

}  // namespace

std::vector<CaseRow> rows_of(const StudyCase& seen, const StudyOptions& options,
                             std::span<const Peer> peers) {
  const LightShape& light = seen.scene.lights.front().shape;
  std::vector<CaseRow> rows;
  for (const MethodInfo& method : methods()) {
    if (!asked_for(options, method.name) || !takes(method, light)) continue;
    for (Setting& setting : settings_of(method, options.quick))
      if (seen.sweep.empty() || setting.varied.empty()) rows.push_back({.setting = std::move(setting)});
  }
  for (const Peer& peer : peers)
    if (asked_for(options, peer.name) && seen.sweep.empty() && takes(peer, light))
      for (const Setting& setting : peer.settings) rows.push_back({.setting = setting, .peer = &peer});
  return rows;
}

std::string key_of(const StudyCase& seen, const std::string& digest, const Setting& setting) {
  return seen.id() + " | " + setting.label() + " | " + digest;
}

std::string to_bytes(const StudyUnit& unit) {
  return packed({{"case", unit.case_number}, {"rows", unit.rows}});
}

std::string to_bytes(const UnitResult& result) {
  json pictures = json::object();
  for (const auto& [name, bytes] : result.pictures)
    pictures[name] = json::binary({bytes.begin(), bytes.end()});
  return packed({{"seen", result.seen},
                 {"rows", result.rows},
                 {"pictures", std::move(pictures)},
                 {"complaint", result.complaint}});
}

StudyUnit unit_of(const std::string& bytes) {
  const json value = unpacked(bytes);
  return {.case_number = value.at("case"), .rows = value.at("rows")};
}

UnitResult result_of(const std::string& bytes) {
  const json value = unpacked(bytes);
  UnitResult out{
      .seen = value.at("seen"), .rows = value.at("rows"), .pictures = {}, .complaint = value.at("complaint")};
  for (const auto& [name, picture] : value.at("pictures").items()) {
    const auto& binary = picture.get_binary();
    out.pictures[name] = {binary.begin(), binary.end()};
  }
  return out;
}

}  // namespace penumbra::apps
