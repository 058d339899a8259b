#include "mesh/io/read_file.h"

#include <fstream>
#include <system_error>

#include "mesh/io/cursor.h"

namespace penumbra::detail {

namespace fs = std::filesystem;

std::vector<std::byte> read_bytes(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    fail_reading(name, "", "no such file", "check the path");
  }
  if (status.type() == fs::file_type::none) {
    fail_reading(name, "", "cannot be opened: " + error.message(), "check the path and permissions");
  }
  if (status.type() != fs::file_type::regular) {
    const bool folder = status.type() == fs::file_type::directory;
    fail_reading(name, "", folder ? "is a folder" : "is not a regular file", "name a mesh file");
  }
  std::ifstream in(path, std::ios::binary);
  const std::uintmax_t size = fs::file_size(path, error);
  if (!in || error) {
    fail_reading(name, "", "cannot be opened", "check its permissions");
  }
  if (size == 0) {
    fail_reading(name, "", "the file is empty", "export it again");
  }
  std::vector<std::byte> bytes(size);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(in.gcount()) != size) {
    fail_reading(name, "byte " + std::to_string(in.gcount()), "reading stopped", "check the disk");
  }
  return bytes;
}

}  // namespace penumbra::detail
