#include "apps/cli/study/study_record.h"

#include <algorithm>
#include <fstream>
#include <map>

#include "apps/common/outputs.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;

std::string line_of(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

/// A cell of a CSV file, by RFC 4180.
std::string cell_of(const json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  const std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted += '"';
}

/// A column of the CSV file: its name, and where it is in a row or, where a row has none, in its case.
struct Column {
  const char* name;
  const char* pointer;
};
constexpr Column kColumns[] = {
    {"scene", "/scene"},
    {"width", "/width"},
    {"height", "/height"},
    {"light_scale", "/light_scale"},
    {"sweep", "/sweep"},
    {"caster_faces", "/caster_faces"},
    {"method", "/method"},
    {"setting", "/label"},
    {"refused", "/refused"},
    {"frame_ms", "/frame_ms/median"},
    {"frame_ms_low", "/frame_ms/low"},
    {"frame_ms_high", "/frame_ms/high"},
    {"frames", "/frame_ms/frames"},
    {"over_default", "/over_default/median"},
    {"over_default_low", "/over_default/low"},
    {"over_default_high", "/over_default/high"},
    {"visibility_ms", "/visibility_ms"},
    {"peak_mib", "/peak_mib"},
    {"rmse", "/error/penumbra/rmse"},
    {"rmse_low", "/error/penumbra/rmse_low"},
    {"rmse_high", "/error/penumbra/rmse_high"},
    {"mean", "/error/penumbra/mean"},
    {"median", "/error/penumbra/median"},
    {"p99", "/error/penumbra/p99"},
    {"max", "/error/penumbra/max"},
    {"all_rmse", "/error/all/rmse"},
    {"all_mean", "/error/all/mean"},
    {"all_p99", "/error/all/p99"},
    {"all_max", "/error/all/max"},
    {"double_rmse", "/error/double/penumbra/rmse"},
    {"double_rmse_low", "/error/double/penumbra/rmse_low"},
    {"double_rmse_high", "/error/double/penumbra/rmse_high"},
    {"flip", "/error/flip"},
    {"certified", "/error/certificates/pixels"},
    {"wrong_certificates", "/error/certificates/contradicted"},
    {"wrong_certificates_double", "/error/double/contradicted"},
};

std::string csv_of(const StudyRecord& record) {
  std::string text;
  const auto end_line = [&text] { text.back() = '\n'; };
  for (const Column& column : kColumns) text.append(column.name) += ',';
  end_line();
  std::map<std::string, const json*> cases;
  for (const json& seen : record.cases()) cases[seen.at("id")] = &seen;
  for (const json& row : record.rows()) {
    const json& seen = *cases.at(row.at("case"));
    for (const Column& column : kColumns) {
      const json::json_pointer pointer(column.pointer);
      const json* owner = row.contains(pointer) ? &row : seen.contains(pointer) ? &seen : nullptr;
      text.append(owner ? cell_of(owner->at(pointer)) : "") += ',';
    }
    end_line();
  }
  return text;
}

/// One row a line, so that two runs can be compared.
std::string json_of(const StudyRecord& record) {
  std::string text = "{\"about\": " + record.about().dump() + ",\n\"cases\": [";
  const auto add_all = [&text](const std::vector<json>& values) {
    for (const json& value : values) {
      text += &value == values.data() ? "\n " : ",\n ";
      text += line_of(value);
      text.pop_back();
    }
  };
  add_all(record.cases());
  text += "],\n\"rows\": [";
  add_all(record.rows());
  return text + "]}\n";
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_file(path, [&text](std::ostream& out) { out << text; });
}

}  // namespace

StudyRecord::StudyRecord(std::filesystem::path folder, json about)
    : folder_(std::move(folder)), about_(std::move(about)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  require_writable(file());
  if (std::filesystem::exists(file())) read();
  if (cases_.empty() && rows_.empty()) write_text(file(), line_of({{"about", about_}}));
}

void StudyRecord::read() {
  std::ifstream in(file());
  std::string kept;
  bool cut = false;
  for (std::string text; std::getline(in, text);) {
    const json line = json::parse(text, nullptr, false);
    if (line.is_discarded()) {
      cut = true;
      continue;
    }
    if (line.contains("about") && line["about"] != about_)
      throw UsageError(file().string() + ": was measured by " + line["about"].dump() + ", this is " +
                       about_.dump() + "; choose another --output");
    take(line);
    kept += text + "\n";
  }
  if (cut) write_text(file(), kept);
}

void StudyRecord::forget_another(const json& seen) {
  const auto is_another = [&](const json& other) {
    return other.at("id") == seen.at("id") && other.value("digest", "") != seen.value("digest", "");
  };
  if (std::erase_if(cases_, is_another) == 0) return;
  std::erase_if(rows_, [&](const json& row) {
    const bool is_its = row.at("case") == seen.at("id");
    if (is_its) keys_.erase(row.at("key").get<std::string>());
    return is_its;
  });
}

void StudyRecord::take(const json& line) {
  if (line.contains("case")) {
    forget_another(line["case"]);
    cases_.push_back(line["case"]);
  }
  if (!line.contains("row")) return;
  rows_.push_back(line["row"]);
  keys_.insert(line["row"].at("key").get<std::string>());
}

void StudyRecord::append(const json& line) const {
  std::ofstream out(file(), std::ios::app);
  out << line_of(line) << std::flush;
  if (!out) throw SystemError(file().string() + ": cannot be written; is the disk full?");
}

void StudyRecord::add_case(const json& seen) {
  if (std::ranges::any_of(cases_, [&](const json& other) { return other == seen; })) return;
  append({{"case", seen}});
  take({{"case", seen}});
}

void StudyRecord::add_row(const json& row) {
  append({{"row", row}});
  take({{"row", row}});
}

std::size_t StudyRecord::add(const UnitResult& result) {
  std::filesystem::create_directories(folder_ / "pictures");
  for (const auto& [name, bytes] : result.pictures) write_text(folder_ / "pictures" / name, bytes);
  std::size_t added = 0;
  for (const json& row : result.rows) {
    if (has_row(row.at("key"))) continue;
    add_case(result.seen);
    add_row(row);
    ++added;
  }
  return added;
}

void write_tables(const StudyRecord& record) {
  write_text(record.folder() / "study.json", json_of(record));
  write_text(record.folder() / "study.csv", csv_of(record));
}

}  // namespace penumbra::apps
