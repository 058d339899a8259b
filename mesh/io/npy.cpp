#include "mesh/io/npy.h"

#include <bit>
#include <charconv>
#include <ostream>
#include <span>
#include <string_view>

#include "mesh/io/cursor.h"
#include "mesh/io/read_file.h"

namespace penumbra::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::string_view kMagic = "\x93NUMPY";

/// What stands after 'key': in the header's dictionary; empty where the key is missing.
std::string_view entry(std::string_view header, std::string_view key) {
  std::string quoted(1, '\'');
  quoted.append(key).push_back('\'');
  const std::size_t at = header.find(quoted);
  if (at == std::string_view::npos) return {};
  std::string_view rest = header.substr(at + key.size() + 2);
  while (rest.starts_with(' ') || rest.starts_with(':')) rest.remove_prefix(1);
  return rest;
}

/// Two numbers in brackets. False for any other shape.
bool parse_shape(std::string_view text, NpyRows& out) {
  if (!text.starts_with('(')) return false;
  const char* at = text.data() + 1;
  const char* end = text.data() + text.size();
  const auto next = [&](std::size_t& value, char after) {
    while (at < end && *at == ' ') ++at;
    const auto [stop, error] = std::from_chars(at, end, value);
    at = stop;
    return error == std::errc() && at < end && *at++ == after;
  };
  return next(out.rows, ',') && next(out.columns, ')');
}

/// The header's text, and where the values begin.
std::pair<std::string_view, std::size_t> header_of(std::string_view text, const std::string& name,
                                                   const char* advice) {
  if (!text.starts_with(kMagic) || text.size() < 12)
    fail_reading(name, "byte 0", "does not begin as a NumPy array does", advice);
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(text[i])}; };
  const bool old = text[6] == 1;
  const std::size_t begin = old ? 10 : 12;
  const std::size_t length = byte(8) | byte(9) << 8 | (old ? 0 : byte(10) << 16 | byte(11) << 24);
  if (length > text.size() - begin)
    fail_reading(name, "byte 8", "the header is longer than the file", "it is truncated; save it again");
  return {text.substr(begin, length), begin + length};
}

template <class T>
void read_values(std::span<const std::byte> bytes, const std::string& name, std::endian order, bool fortran,
                 NpyRows& out) {
  const std::size_t room = bytes.size() / sizeof(T);
  if (out.columns != 0 && out.rows > room / out.columns)
    fail_reading(name, "",
                 "the header promises " + std::to_string(out.rows) + " rows, but there is room for " +
                     std::to_string(room / out.columns),
                 "it is truncated; save it again");
  ByteCursor cursor(bytes, name, order);
  out.values.resize(out.rows * out.columns);
  for (std::size_t i = 0; i < out.values.size(); ++i)
    out.values[fortran ? i % out.rows * out.columns + i / out.rows : i] = cursor.read<T>();
}

}  // namespace

void write_npy_header(std::ostream& out, const std::vector<std::size_t>& shape) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (";
  for (std::size_t k = 0; k < shape.size(); ++k) {
    if (k > 0) header += " ";
    header += std::to_string(shape[k]);
    if (k + 1 < shape.size() || k == 0) header += ",";
  }
  header += "), }";
  // It ends at a multiple of 64 bytes.
  constexpr std::size_t kBefore = 10;
  while ((kBefore + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  out << kMagic << '\x01' << '\0';
  const auto length = static_cast<std::uint16_t>(header.size());
  out.write(reinterpret_cast<const char*>(&length), 2);
  out << header;
}

NpyRows read_npy_rows(const std::filesystem::path& path, const char* advice) {
  const std::string name = path.string();
  const std::vector<std::byte> bytes = read_bytes(path);
  const auto [header, begin] = header_of(as_text(bytes), name, advice);
  NpyRows out;
  if (!parse_shape(entry(header, "shape"), out))
    fail_reading(name, "header", "the array has not two dimensions", advice);
  const std::string_view type = entry(header, "descr").substr(0, 5);
  const bool fortran = entry(header, "fortran_order").starts_with("True");
  const auto order = type.starts_with("'>") ? std::endian::big : std::endian::little;
  const auto values = std::span(bytes).subspan(begin);
  if (type == "'<f8'" || type == "'>f8'")
    read_values<double>(values, name, order, fortran, out);
  else if (type == "'<f4'" || type == "'>f4'")
    read_values<float>(values, name, order, fortran, out);
  else
    fail_reading(name, "header", "the numbers are of another type than float32 and float64", advice);
  return out;
}

}  // namespace penumbra::detail
