#include "apps/cli/study/page/study_page.h"

#include <fstream>
#include <iterator>

#include "apps/cli/study/page/base64.h"
#include "mesh/io/write_file.h"

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

json pictures_of(const StudyRecord& record) {
  const std::filesystem::path folder = record.folder() / "pictures";
  json pictures = json::object();
  for (const json& seen : record.cases())
    for (const char* key : {"lit_picture", "reference_picture", "disks_picture"})
      add_picture(pictures, folder, seen, key);
  for (const json& row : record.rows()) add_picture(pictures, folder, row, "picture");
  return pictures;
}

/// No part of it ends the script that it stands in.
std::string script_safe(std::string text) {
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.replace(at, 2, "<\\/");
  return text;
}

void replace_mark(std::string& page, const std::string& mark, const std::string& text) {
  page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string make_page(const StudyRecord& record) {
  std::string page(page_text("index.html")), styles, scripts;
  for (const char* name : kStyles) styles += std::string(page_text(name)) + "\n";
  for (const char* name : kScripts) scripts += "<script>\n" + std::string(page_text(name)) + "</script>\n";
  const json data = {{"about", record.about()},
                     {"cases", record.cases()},
                     {"rows", record.rows()},
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
