#include "apps/cli/study/page/study_page.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "apps/cli/study/page/base64.h"
#include "mesh/io/write_file.h"
#include "penumbra/render/method.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;

constexpr const char* kScripts[] = {"uPlot.iife.min.js", "data.js",   "pictures.js", "plots.js",
                                    "tables.js",         "growth.js", "main.js"};
constexpr const char* kStyles[] = {"uPlot.min.css", "page.css"};

void add_picture(json& pictures, const std::filesystem::path& folder, const json& owner, const char* key) {
  if (!owner.contains(key)) return;
  const std::string name = owner[key];
  std::ifstream in(folder / name, std::ios::binary);
  if (!in) return;
  pictures[name] = base64_of(std::string(std::istreambuf_iterator<char>(in), {}));
}

/// Keys of the rows whose pictures are shown at full size: the defaults, and those than which none of the
/// same case is both faster and more accurate; none of cases that show how cost grows.
std::set<std::string> large_pictures(const StudyRecord& record) {
  std::map<std::string, std::vector<const json*>> by_case;
  for (const json& row : record.rows())
    if (!row.contains("refused")) by_case[row.at("case")].push_back(&row);
  for (const json& seen : record.cases())
    if (seen.at("sweep") != "") by_case.erase(seen.at("id").get<std::string>());
  const auto number = [](const json& row, const char* pointer) {
    return row.at(json::json_pointer(pointer)).get<double>();
  };
  std::set<std::string> keys;
  for (auto& [name, rows] : by_case) {
    std::ranges::sort(rows, {}, [&](const json* row) { return number(*row, "/frame_ms/median"); });
    double best = std::numeric_limits<double>::infinity();
    for (const json* row : rows) {
      const double error = number(*row, "/error/penumbra/rmse");
      if (error < best || row->at("varied") == "") keys.insert(row->at("key"));
      best = std::min(best, error);
    }
  }
  return keys;
}

json pictures_of(const StudyRecord& record) {
  const std::filesystem::path folder = record.folder() / "pictures";
  json pictures = json::object();
  for (const json& seen : record.cases())
    for (const char* key : {"lit_picture", "reference_picture", "disks_picture"})
      add_picture(pictures, folder, seen, key);
  const std::set<std::string> large = large_pictures(record);
  for (const json& row : record.rows())
    add_picture(pictures, folder, row, large.contains(row.at("key")) ? "picture" : "small_picture");
  return pictures;
}

/// No part of it ends the script that it stands in.
std::string script_safe(std::string text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 6))
    text.replace(at, 1, "\\u003c");
  return text;
}

void replace_mark(std::string& page, const std::string& mark, const std::string& text) {
  page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string make_page(const StudyRecord& record) {
  json summaries = json::object();
  for (const MethodInfo& info : methods()) summaries[info.name] = info.summary;
  std::string page(page_text("index.html")), styles, scripts;
  for (const char* name : kStyles) styles += std::string(page_text(name)) + "\n";
  for (const char* name : kScripts) scripts += "<script>\n" + std::string(page_text(name)) + "</script>\n";
  const json data = {{"about", record.about()},
                     {"cases", record.cases()},
                     {"rows", record.rows()},
                     {"summaries", summaries},
                     {"pictures", pictures_of(record)}};
  replace_mark(page, "<!-- styles -->", "<style>\n" + styles + "</style>");
  replace_mark(page, "<!-- data -->",
               "<script id=\"data\" type=\"application/json\">" +
                   script_safe(data.dump(-1, ' ', false, json::error_handler_t::replace)) + "</script>");
  replace_mark(page, "<!-- scripts -->", scripts);
  return page;
}

void write_page(const StudyRecord& record) {
  write_file(record.folder() / "index.html", [&](std::ostream& out) { out << make_page(record); });
}

}  // namespace penumbra::apps
